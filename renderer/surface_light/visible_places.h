// Visibility of a flat light from a point: blockers are rasterised into a bit mask on the light;
// the paper draws them into a picture seen from the point.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

// A surface in one plane, in a rectangle of side × side places.
struct FlatLight {
  static constexpr int kMostSide = 64;
  using Rows = std::array<uint64_t, kMostSide>;  // one bit per place

  int side = kMostSide;         // a multiple of 8
  vec3 origin{0.0f};            // a corner of the rectangle
  vec3 across{0.0f}, up{0.0f};  // its sides [m]
  vec3 normal{0.0f};            // unit normal of the emitting side
  bool bothSides = false;
  std::vector<vec3> triangles;  // three corners each
  Rows shape{};                 // the places that lie on the light

  vec3 place(float column, float row) const {
    return origin + (column * across + row * up) / static_cast<float>(side);
  }
  // Whether the point is on a side that emits.
  bool emitsTowards(const vec3& x) const {
    const float height = glm::dot(x - origin, normal);
    return bothSides ? height != 0.0f : height > 0.0f;
  }
};

// The surface of an object as a flat light; none if it is not planar or has no area.
std::optional<FlatLight> flatLightOf(const RenderScene& scene, uint32_t object, int side);

class VisiblePlaces {
 public:
  // Starts with all places visible from x, which must not lie in the plane of the light.
  VisiblePlaces(const FlatLight& light, const vec3& x);

  // Hides the places whose centres lie behind the triangle as seen from x. Parts of the triangle
  // behind the light, or very near the plane through x parallel to the light (a thousandth of the
  // distance of the light), hide nothing.
  void block(const vec3& a, const vec3& b, const vec3& c);

  bool isVisible(int column, int row) const {
    return (blocked_[static_cast<size_t>(row)] >> column & 1u) == 0;
  }
  // Σ w·visible / Σ w over the places of the light, with the weight w = cos θ cos θ' / r² at the
  // centre of each block of 8 × 8 places; 0 if all weights are 0. `n`: unit normal at x.
  float visibleShare(const vec3& n) const;

 private:
  const FlatLight& light_;
  vec3 x_;
  float height_;  // signed height of x above the plane of the light [m]
  FlatLight::Rows blocked_{};
};

}  // namespace lamplighter
