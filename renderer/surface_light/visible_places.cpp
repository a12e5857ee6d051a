#include "renderer/surface_light/visible_places.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <span>

namespace lamplighter {
namespace {

constexpr float kSameDirection = 0.9999f;
// Range of depths between the point (0) and the light (1) in which blockers count.
constexpr float kLeastDepth = 1e-3f, kMostDepth = 1.0f - 1e-4f;
constexpr int kBlock = 8;

// Bits [from, to).
uint64_t bitsBetween(int from, int to) {
  if (to <= from) return 0;
  const uint64_t below = to >= 64 ? ~uint64_t{0} : (uint64_t{1} << to) - 1;
  return below & ~((uint64_t{1} << from) - 1);
}

// Sets the bits of the places whose centres lie in a convex polygon [places].
void fill(std::span<const vec2> polygon, int side, FlatLight::Rows& rows) {
  float lowest = polygon[0].y, highest = polygon[0].y;
  for (const vec2& p : polygon) {
    lowest = std::min(lowest, p.y);
    highest = std::max(highest, p.y);
  }
  const auto limited = [&](float v) {
    return static_cast<int>(std::clamp(std::ceil(v - 0.5f), 0.0f, static_cast<float>(side)));
  };
  for (int row = limited(lowest); row < limited(highest); ++row) {
    const float y = static_cast<float>(row) + 0.5f;
    float left = std::numeric_limits<float>::infinity(), right = -left;
    for (size_t i = 0; i < polygon.size(); ++i) {
      const vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if ((a.y <= y) == (b.y <= y)) continue;
      const float x = a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y));
      left = std::min(left, x);
      right = std::max(right, x);
    }
    if (left < right) rows[static_cast<size_t>(row)] |= bitsBetween(limited(left), limited(right));
  }
}

}  // namespace

std::optional<FlatLight> flatLightOf(const RenderScene& scene, uint32_t object, int side) {
  const RenderObject& o = scene.objects[object];
  FlatLight light;
  light.side = side;
  light.bothSides = scene.materials[static_cast<size_t>(o.material)].doubleSided;
  vec3 edge(0.0f);
  for (uint32_t i = 0; i < o.indexCount; i += 3) {
    std::array<vec3, 3> t;
    for (uint32_t c = 0; c < 3; ++c) t[c] = scene.positions[scene.indices[o.firstIndex + i + c]];
    const vec3 cross = glm::cross(t[1] - t[0], t[2] - t[0]);
    const float length = glm::length(cross);
    if (!(length > 0.0f)) continue;
    if (light.triangles.empty()) {
      light.normal = cross / length;
      edge = glm::normalize(t[1] - t[0]);
      light.origin = t[0];
    }
    if (glm::dot(light.normal, cross) < kSameDirection * length) return std::nullopt;
    light.triangles.insert(light.triangles.end(), t.begin(), t.end());
  }
  if (light.triangles.empty()) return std::nullopt;
  const vec3 other = glm::cross(light.normal, edge);
  vec2 low(std::numeric_limits<float>::infinity()), high = -low;
  for (const vec3& p : light.triangles) {
    const vec2 at(glm::dot(p - light.origin, edge), glm::dot(p - light.origin, other));
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  const float slack = 1e-3f * std::max(high.x - low.x, high.y - low.y);
  for (const vec3& p : light.triangles)
    if (std::abs(glm::dot(p - light.origin, light.normal)) > slack) return std::nullopt;
  light.origin += low.x * edge + low.y * other;
  light.across = (high.x - low.x) * edge;
  light.up = (high.y - low.y) * other;
  const float scale = static_cast<float>(side);
  for (size_t i = 0; i < light.triangles.size(); i += 3) {
    std::array<vec2, 3> t;
    for (size_t c = 0; c < 3; ++c) {
      const vec3 d = light.triangles[i + c] - light.origin;
      t[c] =
          scale * vec2(glm::dot(d, edge) / (high.x - low.x), glm::dot(d, other) / (high.y - low.y));
    }
    fill(t, side, light.shape);
  }
  return light;
}

VisiblePlaces::VisiblePlaces(const FlatLight& light, const vec3& x)
    : light_(light), x_(x), height_(glm::dot(x - light.origin, light.normal)) {}

void VisiblePlaces::block(const vec3& a, const vec3& b, const vec3& c) {
  // Depth 0 at x, 1 in the plane of the light; clipped to the range between.
  std::array<vec3, 8> polygon{a, b, c}, clipped;
  size_t count = 3;
  const auto depth = [&](const vec3& p) { return glm::dot(x_ - p, light_.normal) / height_; };
  for (const bool atFar : {false, true}) {
    size_t kept = 0;
    for (size_t i = 0; i < count; ++i) {
      const vec3 &p = polygon[i], &q = polygon[(i + 1) % count];
      const float dp = atFar ? kMostDepth - depth(p) : depth(p) - kLeastDepth;
      const float dq = atFar ? kMostDepth - depth(q) : depth(q) - kLeastDepth;
      if (dp >= 0.0f) clipped[kept++] = p;
      if ((dp > 0.0f && dq < 0.0f) || (dp < 0.0f && dq > 0.0f))
        clipped[kept++] = p + (q - p) * (dp / (dp - dq));
    }
    count = kept;
    if (count < 3) return;
    std::copy_n(clipped.begin(), count, polygon.begin());
  }
  std::array<vec2, 8> projected;
  const float side = static_cast<float>(light_.side);
  const vec3 across = side * light_.across / glm::dot(light_.across, light_.across);
  const vec3 up = side * light_.up / glm::dot(light_.up, light_.up);
  for (size_t i = 0; i < count; ++i) {
    const vec3 d = x_ + (polygon[i] - x_) / depth(polygon[i]) - light_.origin;
    projected[i] = {glm::dot(d, across), glm::dot(d, up)};
  }
  fill(std::span(projected).first(count), light_.side, blocked_);
}

float VisiblePlaces::visibleShare(const vec3& n) const {
  float visible = 0.0f, whole = 0.0f;
  const int blocks = light_.side / kBlock;
  for (int by = 0; by < blocks; ++by) {
    for (int bx = 0; bx < blocks; ++bx) {
      int on = 0, seen = 0;
      for (int row = kBlock * by; row < kBlock * (by + 1); ++row) {
        const auto r = static_cast<size_t>(row);
        const uint64_t shape = light_.shape[r] >> (kBlock * bx) & 0xffu;
        on += std::popcount(shape);
        seen += std::popcount(shape & ~(blocked_[r] >> (kBlock * bx)));
      }
      if (on == 0) continue;
      const vec3 d = light_.place(kBlock * (static_cast<float>(bx) + 0.5f),
                                  kBlock * (static_cast<float>(by) + 0.5f)) -
                     x_;
      const float d2 = glm::dot(d, d);
      const float here = std::max(0.0f, glm::dot(d, n));
      const float weight = here * std::abs(height_) / (d2 * d2);
      visible += weight * static_cast<float>(seen);
      whole += weight * static_cast<float>(on);
    }
  }
  return whole > 0.0f ? visible / whole : 0.0f;
}

}  // namespace lamplighter
