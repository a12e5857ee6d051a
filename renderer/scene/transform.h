// An affine transform in the parts that a person edits.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

// local = T(translation) · R(rotation) · S(scale) · H(shear), H = unit upper triangular with
// xy, xz, yz above the diagonal. Shear is zero but for glTF nodes whose matrix is no T·R·S product,
// so that every affine matrix has a place here (QR decomposition).
struct Transform {
  vec3 translation{0.0f};                 // metres, in the parent's space
  quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  // unit
  vec3 scale{1.0f};
  vec3 shear{0.0f};  // xy, xz, yz

  bool operator==(const Transform&) const = default;
};

mat4 toMatrix(const Transform& t);

// The parts of an affine matrix. A singular matrix gives scale 0 on the axes that collapse.
Transform decompose(const mat4& m);

}  // namespace lamplighter
