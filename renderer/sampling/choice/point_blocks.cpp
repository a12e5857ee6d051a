#include "renderer/sampling/choice/point_blocks.h"

#include <algorithm>

#include "renderer/base/simd.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {

PointBlocks::PointBlocks(std::span<const SeenPoint> points)
    : size_(std::min(points.size(), kMostPoints)) {
  for (size_t i = 0; i < size_; ++i) {
    points_[i] = points[i];
    positions_.set(i, points[i].position);
    normals_.set(i, points[i].normal);
    rounding_ = std::max(rounding_, rayEpsilon(points[i].position));
    leftOutByAny_ |= points[i].leftOutBy;
  }
}

void PointBlocks::geometries(const shared::Vpl& vpl, float clampDistance, size_t first, size_t end,
                             float* out) const {
  if (vpl.position.w != shared::kVplCosine) {
    for (size_t i = first * kLanes; i < end * kLanes; ++i)
      *out++ = i < size_ ? shared::vplGeometry(vpl, points_[i].position, points_[i].normal,
                                               points_[i].normal, clampDistance)
                         : 0.0f;
    return;
  }
  const Floats8 zero = hn::Zero(kTag), least = broadcast(clampDistance * clampDistance);
  const SimdVec3<Floats8> place = broadcast(vec3(vpl.position)), axis = broadcast(vec3(vpl.normal));
  for (size_t i = first * kLanes; i < end * kLanes; i += kLanes, out += kLanes) {
    const auto load = [&](const Vectors& v) {
      return SimdVec3<Floats8>{hn::Load(kTag, &v.x[i]), hn::Load(kTag, &v.y[i]),
                               hn::Load(kTag, &v.z[i])};
    };
    const SimdVec3<Floats8> v = load(positions_) - place;
    const Floats8 z = dotUnfused(v, axis), s = hn::Neg(dotUnfused(load(normals_), v));
    const Floats8 d2 = dotUnfused(v, v);
    const Floats8 geometry = hn::Div(hn::Mul(s, z), hn::Mul(d2, hn::Max(d2, least)));
    const auto isLit = hn::And(hn::Gt(z, zero), hn::Gt(s, zero));
    hn::Store(hn::IfThenElseZero(isLit, geometry), kTag, out);
  }
}

uint32_t PointBlocks::leftOut(uint32_t link, size_t block) const {
  uint32_t lanes = 0;
  if (!isLeftOut(leftOutByAny_, link)) return lanes;
  const size_t first = block * kLanes;
  for (size_t i = first; i < std::min(first + kLanes, size_); ++i)
    if (isLeftOut(points_[i].leftOutBy, link)) lanes |= 1u << (i - first);
  return lanes;
}

}  // namespace lamplighter
