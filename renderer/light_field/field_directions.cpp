#include "renderer/light_field/field_directions.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

constexpr uint32_t kTurnSet = 0xf1e1d;
constexpr uint32_t kMissing = 0xffffffffu;

// Uniform among all rotations (Shoemake, "Uniform Random Rotations", Graphics Gems III, 1992).
mat3 rotationOf(uint32_t turn) {
  const float u = toUnitFloat(hash4(turn, 0, 0, kTurnSet));
  const float a = 2.0f * kPi * toUnitFloat(hash4(turn, 1, 0, kTurnSet));
  const float b = 2.0f * kPi * toUnitFloat(hash4(turn, 2, 0, kTurnSet));
  const float s = std::sqrt(1.0f - u), t = std::sqrt(u);
  return glm::mat3_cast(quat(t * std::cos(b), s * std::sin(a), s * std::cos(a), t * std::sin(b)));
}

// A place of the upper half of the map, |x| + |y| ≤ 1, on the sphere.
vec3 onSphere(float x, float y) {
  const float r = std::abs(x) + std::abs(y);
  if (r == 0.0f) return {0.0f, 0.0f, 1.0f};
  const float turn = 0.5f * kPi * std::abs(y) / r;
  const float side = r * std::sqrt(2.0f - r * r);
  return {std::copysign(side * std::cos(turn), x), std::copysign(side * std::sin(turn), y),
          1.0f - r * r};
}

// The inverse, for z ≥ 0.
vec2 onMap(const vec3& d) {
  const float r = std::sqrt(std::max(0.0f, 1.0f - d.z));
  const float share = std::atan2(std::abs(d.y), std::abs(d.x)) / (0.5f * kPi);
  return {std::copysign(r * (1.0f - share), d.x), std::copysign(r * share, d.y)};
}

}  // namespace

FieldDirections::FieldDirections(int divisions, uint32_t turn)
    : divisions_(std::max(divisions, 1)), rotation_(rotationOf(turn)) {
  const int f = divisions_;
  numbers_.assign(static_cast<size_t>((2 * f + 1) * (2 * f + 1)), kMissing);
  const float scale = 1.0f / static_cast<float>(f);
  for (int j = -f; j <= f; ++j) {
    for (int i = -f; i <= f; ++i) {
      const int k = f - std::abs(i) - std::abs(j);
      // On the equator: only one of each two opposite ends.
      if (k < 0 || (k == 0 && (j < 0 || (j == 0 && i < 0)))) continue;
      numbers_[static_cast<size_t>((j + f) * (2 * f + 1) + i + f)] =
          static_cast<uint32_t>(directions_.size());
      const vec3 local = onSphere(scale * static_cast<float>(i), scale * static_cast<float>(j));
      directions_.push_back(glm::normalize(rotation_ * local));
      // All triangles of the map have the same area; corners of the octahedron are in four of them,
      // other vertices in six, and the integral of a hat over a triangle is a third of its area.
      const bool isCorner = std::abs(i) == f || std::abs(j) == f || k == f;
      weights_.push_back((isCorner ? 4.0f : 6.0f) * kPi / (6.0f * static_cast<float>(f * f)));
    }
  }
}

uint32_t FieldDirections::numberAt(int i, int j) const {
  return numbers_[static_cast<size_t>((j + divisions_) * (2 * divisions_ + 1) + i + divisions_)];
}

FieldDirections::Triple FieldDirections::tripleOf(const vec3& direction) const {
  vec3 local = glm::normalize(glm::transpose(rotation_) * direction);
  const bool isOpposite = local.z < 0.0f;
  if (isOpposite) local = -local;
  const int f = divisions_;
  const vec2 at = static_cast<float>(f) * onMap(local);
  const float a = std::abs(at.x), b = std::abs(at.y);
  const int i = std::min(static_cast<int>(a), f), j = std::min(static_cast<int>(b), f - i);
  const float fa = std::clamp(a - static_cast<float>(i), 0.0f, 1.0f);
  const float fb = std::clamp(b - static_cast<float>(j), 0.0f, 1.0f);
  // The lower or the upper triangle of a square of the lattice.
  const bool isUpper = fa + fb > 1.0f && i + j + 2 <= f;
  std::array<glm::ivec2, 3> corners{glm::ivec2(i, j), {i + 1, j}, {i, j + 1}};
  Triple out;
  out.weights = {std::max(0.0f, 1.0f - fa - fb), fa, fb};
  if (isUpper) {
    corners[0] = {i + 1, j + 1};
    out.weights = {fa + fb - 1.0f, 1.0f - fb, 1.0f - fa};
  }
  float sum = 0.0f;
  for (size_t k = 0; k < 3; ++k) {
    // Beyond the equator by rounding.
    if (corners[k].x + corners[k].y > f) {
      out.weights[k] = 0.0f;
      corners[k] = {i, j};
    }
    sum += out.weights[k];
    const glm::ivec2 signs{at.x < 0.0f ? -1 : 1, at.y < 0.0f ? -1 : 1};
    const glm::ivec2 c = corners[k] * signs;
    uint32_t number = numberAt(c.x, c.y);
    const bool isOther = number == kMissing;
    if (isOther) number = numberAt(-c.x, -c.y);
    out.directions[k] = number;
    out.areOpposite[k] = isOpposite != isOther;
  }
  for (float& w : out.weights) w = sum > 0.0f ? w / sum : 1.0f / 3.0f;
  return out;
}

}  // namespace lamplighter
