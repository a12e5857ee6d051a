// Directions of the light field, regular on the sphere (paper 5, the virtual light
// field on the GPU, section 2.1). Each represents itself and its opposite.
//
// They are the vertices of an octahedron whose faces are divided, in the equal-area map of the
// octahedron to the sphere (Clarberg, "Fast Equal-Area Mapping of the (Hemi)Sphere using SIMD",
// 2008), so that weights are closed forms and almost equal.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

class FieldDirections {
 public:
  FieldDirections() = default;
  // 2 divisions² + 1 directions; divisions ≥ 1. `turn`: selects a rotation of all directions.
  FieldDirections(int divisions, uint32_t turn);

  size_t size() const { return directions_.size(); }
  // Unit, world space.
  const vec3& operator[](size_t direction) const { return directions_[direction]; }
  // Integral over the sphere of the hat function of one end [sr], which is 1 at the end, 0 at its
  // neighbours, and linear between them in the map. The sum over both ends of all directions is 4π.
  float weightOf(size_t direction) const { return weights_[direction]; }

  // The ends of the triangle of the map in which a direction lies, and its barycentric weights
  // there (section 3.4).
  struct Triple {
    std::array<uint32_t, 3> directions{};
    std::array<bool, 3> areOpposite{};  // whether the opposite end is meant
    std::array<float, 3> weights{};     // the sum is 1
  };
  Triple tripleOf(const vec3& direction) const;

 private:
  uint32_t numberAt(int i, int j) const;

  int divisions_ = 0;
  mat3 rotation_{1.0f};
  std::vector<vec3> directions_;
  std::vector<float> weights_;
  // Numbers of the directions of the upper half, by column and row of the square map, each from
  // −divisions to divisions.
  std::vector<uint32_t> numbers_;
};

}  // namespace lamplighter
