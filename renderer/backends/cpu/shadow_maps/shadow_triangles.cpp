#include "renderer/backends/cpu/shadow_maps/shadow_triangles.h"

#include <algorithm>
#include <limits>

#include "renderer/base/simd.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter::cpu {
namespace {

using Floats = Floats8;
using Vector3 = SimdVec3<Floats>;

// Error bound of a function, so that two neighbouring triangles do not both skip a tile.
constexpr float kEdgeRounding = 1e-6f;

// Exactly −cross(b, a): neighbours agree on their shared edge.
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
Vector3 operator*(const Vector3& a, Floats s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

// For directional light z is the stored value: 1 one radius above the origin, 0 one radius below.
Vector3 toLight(const LightSpace& light, const Vector3& p) {
  const Vector3 way =
      p - Vector3{broadcast(light.origin.x), broadcast(light.origin.y), broadcast(light.origin.z)};
  const auto along = [&](int axis, float scale) {
    const vec3 a = light.axes[axis] * scale;
    return dotFused(way, {broadcast(a.x), broadcast(a.y), broadcast(a.z)});
  };
  const Floats z = along(2, light.up);
  return {along(0, light.across), along(1, light.across),
          light.isParallel ? hn::Add(z, broadcast(0.5f)) : z};
}

void store(const Vector3& f, float (&out)[4][ShadowTriangles::kLanes]) {
  const Floats size = hn::Add(hn::Add(hn::Abs(f.x), hn::Abs(f.y)), hn::Abs(f.z));
  hn::Store(f.x, kTag, out[0]);
  hn::Store(f.y, kTag, out[1]);
  hn::Store(f.z, kTag, out[2]);
  hn::Store(hn::Mul(size, broadcast(kEdgeRounding)), kTag, out[3]);
}

// Prepares triangles from their corners in light space.
void see(const LightSpace& light, const std::array<Vector3, 3>& corner,
         ShadowTriangles::Batch& out) {
  const auto& [a, b, c] = corner;
  const Vector3 normal = cross(b - a, c - a);
  std::array<Vector3, 3> flat = corner;  // in the space of the rays; z is 1 for directional light
  if (light.isParallel)
    for (Vector3& p : flat) p.z = broadcast(1.0f);
  const Floats det = light.isParallel ? normal.z : dotFused(a, normal);
  const Floats inverse = hn::Div(broadcast(1.0f), det);
  auto isSeen = hn::And(hn::Lt(hn::Abs(inverse), broadcast(std::numeric_limits<float>::max())),
                        hn::Ne(det, hn::Zero(kTag)));
  if (!light.isParallel)
    isSeen = hn::And(isSeen, hn::Gt(hn::Max(a.z, hn::Max(b.z, c.z)), hn::Zero(kTag)));
  out.lanes = bitsOf(isSeen);
  if (out.lanes == 0) return;
  // Directional light: a.z − ((u − a.x) n.x + (v − a.y) n.y) / n.z.
  const Vector3 slope = normal * inverse;
  store(light.isParallel ? Vector3{hn::Neg(slope.x), hn::Neg(slope.y),
                                   hn::MulAdd(slope.x, a.x, hn::MulAdd(slope.y, a.y, a.z))}
                         : slope,
        out.functions[ShadowTriangles::Batch::kPlane]);
  const Floats side = hn::CopySign(broadcast(1.0f), det);
  for (size_t i = 0; i < 3; ++i)
    store(cross(flat[(i + 1) % 3], flat[(i + 2) % 3]) * side, out.functions[i]);
}

}  // namespace

LightSpace::LightSpace(const shared::Vpl& vpl)
    : isParallel(vpl.position.w == shared::kVplDirectional),
      origin(vpl.position),
      axes(vec3(vpl.tangent), glm::cross(vec3(vpl.normal), vec3(vpl.tangent)), vec3(vpl.normal)),
      across(isParallel ? 1.0f / vpl.tangent.w : 1.0f),
      up(isParallel ? 0.5f / vpl.normal.w : 1.0f),
      most(isParallel ? 1.0f : 1.0f / rayEpsilon(origin)) {}

void ShadowTriangles::set(std::vector<Corners> triangles) {
  const auto size = [](const Corners& t) {
    const float area = glm::length(glm::cross(t[1] - t[0], t[2] - t[0]));
    return area > 0.0f ? area : 0.0f;  // NaN counts as 0
  };
  std::stable_sort(triangles.begin(), triangles.end(),
                   [&](const Corners& a, const Corners& b) { return size(a) > size(b); });
  count_ = (triangles.size() + kLanes - 1) / kLanes * kLanes;
  for (size_t c = 0; c < 3; ++c) {
    for (int axis = 0; axis < 3; ++axis) {
      std::vector<float>& out = corners_[c][static_cast<size_t>(axis)];
      out.assign(count_, 0.0f);
      for (size_t i = 0; i < triangles.size(); ++i) out[i] = triangles[i][c][axis];
    }
  }
}

void ShadowTriangles::see(const LightSpace& light, std::span<Batch> out) const {
  for (size_t i = 0; i < out.size(); ++i) {
    std::array<Vector3, 3> corner;
    for (size_t c = 0; c < 3; ++c) {
      const auto load = [&](size_t axis) {
        return hn::LoadU(kTag, &corners_[c][axis][i * kLanes]);
      };
      corner[c] = toLight(light, {load(0), load(1), load(2)});
    }
    cpu::see(light, corner, out[i]);
  }
}

}  // namespace lamplighter::cpu
