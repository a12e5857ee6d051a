// An affine transform in components that a user can edit.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

// local = T(translation) · R(rotation) · S(scale) · H(shear), with H unit upper triangular and xy,
// xz, yz above the diagonal. Every affine matrix has this form (QR decomposition). Shear is
// non-zero only for glTF nodes whose matrix is not a product T·R·S.
struct Transform {
  vec3 translation{0.0f};                 // metres, in the space of the parent
  quat rotation{1.0f, 0.0f, 0.0f, 0.0f};  // unit
  vec3 scale{1.0f};
  vec3 shear{0.0f};  // xy, xz, yz

  bool operator==(const Transform&) const = default;
};

mat4 toMatrix(const Transform& t);

// Decomposes an affine matrix. A singular matrix gives scale 0 on the collapsed axes.
Transform decompose(const mat4& m);

}  // namespace lamplighter
