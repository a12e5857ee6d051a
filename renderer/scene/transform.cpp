#include "renderer/scene/transform.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

mat4 toMatrix(const Transform& t) {
  const mat3 r = glm::mat3_cast(t.rotation);
  // Columns of S·H, with H unit upper triangular.
  const vec3 c0 = r * (t.scale * vec3(1.0f, 0.0f, 0.0f));
  const vec3 c1 = r * (t.scale * vec3(t.shear.x, 1.0f, 0.0f));
  const vec3 c2 = r * (t.scale * vec3(t.shear.y, t.shear.z, 1.0f));
  return {vec4(c0, 0.0f), vec4(c1, 0.0f), vec4(c2, 0.0f), vec4(t.translation, 1.0f)};
}

namespace {

// A unit vector perpendicular to the unit vector v.
vec3 perpendicular(const vec3& v) { return Frame(v).tangent; }

}  // namespace

Transform decompose(const mat4& m) {
  Transform t;
  t.translation = vec3(m[3]);
  const vec3 a(m[0]), b(m[1]), c(m[2]);

  // Gram-Schmidt (QR): Q is the rotation, R = S·H the rest. A collapsed column gets an arbitrary
  // perpendicular axis, so that Q stays a rotation.
  const float largest = std::max({glm::length(a), glm::length(b), glm::length(c)});
  const float tiny = 1e-7f * largest;
  vec3 q0 = a, q1, q2;
  float s0 = glm::length(a);
  if (s0 > tiny) {
    q0 = a / s0;
  } else {
    s0 = 0.0f;
    q0 = vec3(1.0f, 0.0f, 0.0f);
    if (glm::length(b) > tiny) q0 = perpendicular(glm::normalize(b));
  }
  const float xy = glm::dot(q0, b);
  vec3 rest = b - xy * q0;
  float s1 = glm::length(rest);
  if (s1 > tiny) {
    q1 = rest / s1;
  } else {
    s1 = 0.0f;
    const vec3 other = c - glm::dot(q0, c) * q0;
    q1 = glm::length(other) > tiny ? glm::cross(glm::normalize(other), q0) : perpendicular(q0);
  }
  const float xz = glm::dot(q0, c);
  const float yz = glm::dot(q1, c);
  q2 = glm::cross(q0, q1);
  float s2 = glm::dot(q2, c);  // negative for a mirroring matrix
  if (std::abs(s2) <= tiny) s2 = 0.0f;

  t.rotation = glm::normalize(glm::quat_cast(mat3(q0, q1, q2)));
  t.scale = vec3(s0, s1, s2);
  // Shear below the rounding error becomes 0, so that a T·R·S matrix is recovered exactly.
  const auto share = [&](float r, float s) {
    return std::abs(r) > 1e-5f * largest && s != 0.0f ? r / s : 0.0f;
  };
  t.shear = vec3(share(xy, s0), share(xz, s0), share(yz, s1));
  return t;
}

}  // namespace lamplighter
