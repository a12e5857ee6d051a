#include "renderer/scene/own_space.h"

#include <cmath>

namespace lamplighter {
namespace {

// Rounds to a multiple of 2⁻¹²; no negative zero.
float rounded(float v) { return std::round(v * 4096.0f) / 4096.0f + 0.0f; }

}  // namespace

std::optional<OwnSpace> ownSpaceOf(const RenderObject& object) {
  const mat3 m(object.world);
  const float volume = std::abs(glm::determinant(m));
  if (!(volume > 0.0f) || !std::isfinite(volume)) return std::nullopt;
  OwnSpace out;
  out.translation = vec3(object.world[3]);
  out.scale = std::cbrt(volume);
  // Gram-Schmidt. The last axis is a cross product, so a reflection stays in the stretch.
  const vec3 x = glm::normalize(m[0]);
  const vec3 y = glm::normalize(m[1] - x * glm::dot(x, m[1]));
  out.rotation = mat3(x, y, glm::cross(x, y));
  out.stretch = glm::transpose(out.rotation) * m * (1.0f / out.scale);
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) out.stretch[c][r] = r > c ? 0.0f : rounded(out.stretch[c][r]);
  const float rest = glm::determinant(out.stretch);
  if (!std::isfinite(rest) || !(std::abs(rest) > 0.0f)) return std::nullopt;
  return out;
}

}  // namespace lamplighter
