#include "renderer/backends/cpu/shadow_maps/shadow_triangles.h"

#include <algorithm>
#include <limits>

#include "renderer/base/wide.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter::cpu {
namespace {

using Tag = hn::FixedTag<float, ShadowTriangles::kLanes>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;

// Of a function: what it may be wrong by, so that neighbours do not both leave a tile out.
constexpr float kRounding = 1e-6f;

Floats all(float v) { return hn::Set(kTag, v); }

struct Wide {
  Floats x, y, z;
};
Wide operator-(const Wide& a, const Wide& b) {
  return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)};
}
Floats dot(const Wide& a, const Wide& b) {
  return hn::MulAdd(a.x, b.x, hn::MulAdd(a.y, b.y, hn::Mul(a.z, b.z)));
}
// Exactly that of (b, a) but for the sign: neighbours agree on the edge that they share.
Wide cross(const Wide& a, const Wide& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)),
          hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
Wide operator*(const Wide& a, Floats s) {
  return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)};
}

// Of parallel light z is what is stored: 1 a radius over the origin, 0 under it.
Wide toLight(const LightSpace& light, const Wide& p) {
  const Wide way = p - Wide{all(light.origin.x), all(light.origin.y), all(light.origin.z)};
  const auto along = [&](int axis, float scale) {
    const vec3 a = light.axes[axis] * scale;
    return dot(way, {all(a.x), all(a.y), all(a.z)});
  };
  const Floats z = along(2, light.up);
  return {along(0, light.across), along(1, light.across),
          light.isParallel ? hn::Add(z, all(0.5f)) : z};
}

void store(const Wide& f, float (&out)[4][ShadowTriangles::kLanes]) {
  const Floats size = hn::Add(hn::Add(hn::Abs(f.x), hn::Abs(f.y)), hn::Abs(f.z));
  hn::Store(f.x, kTag, out[0]);
  hn::Store(f.y, kTag, out[1]);
  hn::Store(f.z, kTag, out[2]);
  hn::Store(hn::Mul(size, all(kRounding)), kTag, out[3]);
}

// Corners as seen from the light, and their triangles.
void see(const LightSpace& light, const std::array<Wide, 3>& corner, ShadowTriangles::Batch& out) {
  const auto& [a, b, c] = corner;
  const Wide normal = cross(b - a, c - a);
  std::array<Wide, 3> flat = corner;  // as the rays see them: of parallel ones z is 1
  if (light.isParallel)
    for (Wide& p : flat) p.z = all(1.0f);
  const Floats det = light.isParallel ? normal.z : dot(a, normal);
  const Floats inverse = hn::Div(all(1.0f), det);
  auto isSeen = hn::And(hn::Lt(hn::Abs(inverse), all(std::numeric_limits<float>::max())),
                        hn::Ne(det, hn::Zero(kTag)));
  if (!light.isParallel)
    isSeen = hn::And(isSeen, hn::Gt(hn::Max(a.z, hn::Max(b.z, c.z)), hn::Zero(kTag)));
  out.lanes = bitsOf(isSeen);
  if (out.lanes == 0) return;
  // Of parallel light: a.z − ((u − a.x) n.x + (v − a.y) n.y) / n.z.
  const Wide slope = normal * inverse;
  store(light.isParallel ? Wide{hn::Neg(slope.x), hn::Neg(slope.y),
                                hn::MulAdd(slope.x, a.x, hn::MulAdd(slope.y, a.y, a.z))}
                         : slope,
        out.functions[ShadowTriangles::Batch::kPlane]);
  const Floats side = hn::CopySign(all(1.0f), det);
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
    return area > 0.0f ? area : 0.0f;  // NaN
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
    std::array<Wide, 3> corner;
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
