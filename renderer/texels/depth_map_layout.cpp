#include "renderer/texels/depth_map_layout.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

vec2 signsOf(const vec2& p) { return {p.x < 0.0f ? -1.0f : 1.0f, p.y < 0.0f ? -1.0f : 1.0f}; }

// The lower half of the octahedron is folded over the upper one.
vec2 folded(const vec2& p) { return (1.0f - vec2(std::abs(p.y), std::abs(p.x))) * signsOf(p); }

}  // namespace

uint32_t DepthMapLayout::pixelOf(const vec3& d) const {
  const auto side = static_cast<float>(resolution);
  const auto cell = [&](float x) {  // of [−1, 1]
    return static_cast<uint32_t>(
        std::clamp(static_cast<int>((0.5f * x + 0.5f) * side), 0, resolution - 1));
  };
  const vec3 size = glm::abs(d);
  uint32_t face = 0;
  vec2 p;
  if (kind == DepthMapKind::cube) {
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    p = vec2(d[(axis + 1) % 3], d[(axis + 2) % 3]) / size[axis];
    face = static_cast<uint32_t>(2 * axis + (d[axis] < 0.0f ? 1 : 0));
  } else {
    p = vec2(d) / (size.x + size.y + size.z);
    if (d.z < 0.0f) p = folded(p);
  }
  const auto row = static_cast<uint32_t>(resolution);
  return (face * row + cell(p.y)) * row + cell(p.x);
}

vec3 DepthMapLayout::pointOf(uint32_t pixel) const {
  const auto row = static_cast<uint32_t>(resolution);
  const auto middle = [&](uint32_t i) {
    return 2.0f * (static_cast<float>(i) + 0.5f) / static_cast<float>(resolution) - 1.0f;
  };
  const vec2 p(middle(pixel % row), middle(pixel / row % row));
  if (kind == DepthMapKind::cube) {
    const uint32_t face = pixel / (row * row);
    const auto axis = static_cast<int>(face / 2);
    vec3 d;
    d[axis] = face % 2 == 0 ? 1.0f : -1.0f;
    d[(axis + 1) % 3] = p.x;
    d[(axis + 2) % 3] = p.y;
    return d;
  }
  const float z = 1.0f - std::abs(p.x) - std::abs(p.y);
  return {z < 0.0f ? folded(p) : p, z};
}

float DepthMapLayout::solidAngleOf(uint32_t pixel) const {
  // Solid angle of an area dx dy of a plane on which a coordinate, or the sum of coordinates, is 1.
  const float side = 2.0f / static_cast<float>(resolution), r = glm::length(pointOf(pixel));
  return side * side / (r * r * r);
}

float DepthMapLayout::halfWidth() const {
  // A face of the cube spans 90°; the centre of a face of the octahedron is stretched most.
  return (kind == DepthMapKind::cube ? 1.4142f : 2.8f) / static_cast<float>(resolution);
}

}  // namespace lamplighter
