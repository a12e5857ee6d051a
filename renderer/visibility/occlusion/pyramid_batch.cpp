#include "renderer/visibility/occlusion/pyramid_batch.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/packet_math.h"

namespace lamplighter {
namespace {

using namespace lanes;

template <typename Plane>
SimdVec3<Vec> normalOf(const Plane& p) {
  return {load(p.x), load(p.y), load(p.z)};
}

// Depth of boxes inside planes, with the same order of operations as OcclusionPyramid::mayMeet().
Vec depthOf(const SimdVec3<Vec>& normal, Vec offset, const SimdVec3<Vec>& centre,
            const SimdVec3<Vec>& half) {
  auto farthest = hn::MulAdd(normal.x, centre.x, offset);
  farthest = hn::MulAdd(normal.y, centre.y, farthest);
  farthest = hn::MulAdd(normal.z, centre.z, farthest);
  farthest = hn::MulAdd(hn::Abs(normal.x), half.x, farthest);
  farthest = hn::MulAdd(hn::Abs(normal.y), half.y, farthest);
  return hn::MulAdd(hn::Abs(normal.z), half.z, farthest);
}

// Distance of points from planes, with the same order of operations as OcclusionPyramid::meets().
HWY_INLINE Vec distanceOf(const SimdVec3<Vec>& normal, Vec offset, const SimdVec3<Vec>& point) {
  auto distance = hn::MulAdd(normal.x, point.x, offset);
  distance = hn::MulAdd(normal.y, point.y, distance);
  return hn::MulAdd(normal.z, point.z, distance);
}
uint32_t outside(Vec depths) { return bitsOf(hn::Lt(depths, hn::Zero(kTag))); }

uint32_t inside(Vec depths) { return 0xff & ~outside(depths); }

}  // namespace

void BoxBatch::set(size_t i, const Bounds& box) {
  const vec3 middle = box.centre(), extent = 0.5f * box.extent();
  for (int c = 0; c < 3; ++c) {
    centre[static_cast<size_t>(c)][i] = middle[c];
    half[static_cast<size_t>(c)][i] = extent[c];
  }
}

// The last batch is filled with copies of its last box.
BoxBatches::BoxBatches(std::span<const Bounds> boxes) : size_(boxes.size()) {
  constexpr size_t kBoxes = BoxBatch::kBoxes;
  const auto batchesOf = [](std::span<const Bounds> some) {
    std::vector<BoxBatch> batches((some.size() + kBoxes - 1) / kBoxes);
    for (size_t i = 0; i < batches.size() * kBoxes; ++i)
      batches[i / kBoxes].set(i % kBoxes, some[std::min(i, some.size() - 1)]);
    return batches;
  };
  boxes_ = batchesOf(boxes);
  std::vector<Bounds> around(boxes_.size());
  for (size_t i = 0; i < boxes.size(); ++i) around[i / kBoxes].add(boxes[i]);
  around_ = batchesOf(around);
}

PyramidBatch::PyramidBatch(const LightPacket& lights, const PatchRegion& region)
    : all_(lights.all()) {
  const SimdVec3<Vec> apex = load(lights.position), towards = load(lights.normal);
  const auto margin = hn::Max(load(lights.rounding), set(region.rounding));
  hn::Store(margin, kTag, margin_.data());
  const auto store = [&](Plane& plane, const SimdVec3<Vec>& normal, Vec offset) {
    hn::Store(normal.x, kTag, plane.x.data());
    hn::Store(normal.y, kTag, plane.y.data());
    hn::Store(normal.z, kTag, plane.z.data());
    hn::Store(offset, kTag, plane.offset.data());
  };
  store(planes_[0], towards, hn::Sub(hn::Neg(margin), dot(towards, apex)));

  const vec3 middle = region.middle();
  const SimdVec3<Vec> centre = set(middle), normal = set(region.normal);
  const auto height = dot(apex - centre, normal);
  const auto above = hn::Gt(height, hn::Zero(kTag));
  const auto turn = [&](Vec v) { return hn::IfThenElse(above, v, hn::Neg(v)); };
  const SimdVec3<Vec> up{turn(normal.x), turn(normal.y), turn(normal.z)};
  const auto thickness = set(region.thickness);
  const auto slab = hn::Add(thickness, margin);
  const auto slack = region.chart != kNone ? slab : hn::Mul(set(-3.0f), slab);
  store(planes_[1], up, hn::Sub(slack, dot(up, centre)));

  for (size_t i = 0; i < 4; ++i) {
    const auto at = [&](const auto& v) { return set(vec3(v[0][i], v[1][i], v[2][i])); };
    const SimdVec3<Vec> from = at(region.from);
    const SidePlanes<Vec> side =
        sidePlanes(kTag, from, at(region.sides), from - apex, centre, up, thickness, margin, false);
    store(planes_[2 + i], side.normal, side.offset);
  }
}

// A shape that moves by a vector d approaches a plane with normal n by n·d. This is at most the
// larger of |n·axis| and |n×axis| / across, times the length of d in the metric.
void PyramidBatch::weighBy(const MotionMetric& way) {
  const SimdVec3<Vec> axis = set(way.axis);
  const auto one = set(1.0f), across = set(1.0f / way.across);
  for (Plane& p : planes_) {
    const SimdVec3<Vec> normal = normalOf(p);
    const auto along = dot(normal, axis), squared = dot(normal, normal);
    const auto sideways = hn::Sqrt(hn::Max(hn::NegMulAdd(along, along, squared), hn::Zero(kTag)));
    // A plane that is left out has the normal zero; nothing is outside it.
    const auto most = hn::Max(hn::Max(hn::Abs(along), hn::Mul(sideways, across)), set(1e-20f));
    hn::Store(hn::Max(hn::Div(one, most), one), kTag, p.weight.data());
  }
}

PyramidBatch::Mask PyramidBatch::mayMeetSphere(const vec3& centre, float radius,
                                               Depths& depths) const {
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_) {
    const auto depth = hn::Add(distanceOf(normalOf(p), load(p.offset), set(centre)), set(radius));
    least = hn::Min(hn::Mul(depth, load(p.weight)), least);
  }
  hn::StoreU(least, kTag, depths.data());
  return all_ & inside(least);
}

PyramidBatch::Mask PyramidBatch::mayMeet(const Bounds& box) const {
  const SimdVec3<Vec> centre = set(box.centre()), half = set(0.5f * box.extent());
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_)
    least = hn::Min(depthOf(normalOf(p), load(p.offset), centre, half), least);
  return all_ & inside(least);
}

PyramidBatch::Mask PyramidBatch::mayMeetSphere(const vec3& centre, float radius) const {
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_)
    least = hn::Min(distanceOf(normalOf(p), load(p.offset), set(centre)), least);
  return all_ & ~outside(hn::Add(least, set(radius)));
}

PyramidBatch::Mask PyramidBatch::hold(const vec3& point) const {
  const SimdVec3<Vec> p = set(point);
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& plane : planes_)
    least = hn::Min(distanceOf(normalOf(plane), load(plane.offset), p), least);
  return all_ & bitsOf(hn::Ge(least, load(margin_)));
}

PyramidBatch::Met PyramidBatch::meets(const std::array<vec3, 3>& triangle) const {
  const SimdVec3<Vec> a = set(triangle[0]), b = set(triangle[1]), c = set(triangle[2]);
  auto leastA = set(std::numeric_limits<float>::max()), leastB = leastA, leastC = leastA;
  auto leastOfMost = leastA;  // minimum over planes of the largest distance of a corner
  for (const Plane& p : planes_) {
    const SimdVec3<Vec> normal = normalOf(p);
    const auto offset = load(p.offset);
    const auto da = distanceOf(normal, offset, a), db = distanceOf(normal, offset, b),
               dc = distanceOf(normal, offset, c);
    leastA = hn::Min(da, leastA);
    leastB = hn::Min(db, leastB);
    leastC = hn::Min(dc, leastC);
    leastOfMost = hn::Min(hn::Max(hn::Max(da, db), dc), leastOfMost);
  }
  const Mask open = all_ & ~outside(leastOfMost);
  Met met;
  met.byCorner = {open & ~outside(leastA), open & ~outside(leastB), open & ~outside(leastC)};
  met.unsure = open & ~met.met();
  return met;
}

// A triangle that is not outside either of two planes may still be beyond their common edge: all of
// it is outside a third plane through that edge. This is so if for some positive factor the sum of
// one distance and the factor times the other is negative at each corner.
PyramidBatch::Mask PyramidBatch::surelyMiss(const std::array<vec3, 3>& triangle,
                                            float rounding) const {
  const auto margin = hn::Mul(set(2.0f), hn::Max(load(margin_), set(rounding)));
  std::array<std::array<Vec, 3>, kPlanes> depths;
  for (size_t p = 1; p < kPlanes; ++p) {
    const Plane& plane = planes_[p];
    const auto offset = hn::Add(load(plane.offset), margin);
    for (size_t i = 0; i < 3; ++i)
      depths[p][i] = distanceOf(normalOf(plane), offset, set(triangle[i]));
  }
  const auto zero = hn::Zero(kTag);
  const auto isPastEdge = [&](const std::array<Vec, 3>& a, const std::array<Vec, 3>& b) {
    auto least = zero, most = set(std::numeric_limits<float>::max());  // bounds of the factor
    for (size_t i = 0; i < 3; ++i) {
      const auto factor = hn::Div(hn::Neg(a[i]), b[i]);
      const auto isLower = hn::Lt(b[i], zero);
      least = hn::Max(hn::IfThenElseZero(isLower, factor), least);
      most = hn::Min(hn::IfThenElse(isLower, most, factor), most);
    }
    return hn::Lt(hn::Mul(least, set(1.001f)), most);
  };
  // Edges between the patch's plane and a side, and between two sides.
  auto past = isPastEdge(depths[5], depths[2]);
  for (size_t side = 2; side < 6; ++side) {
    past = hn::Or(past, isPastEdge(depths[1], depths[side]));
    if (side < 5) past = hn::Or(past, isPastEdge(depths[side], depths[side + 1]));
  }
  return all_ & bitsOf(past);
}

PyramidPlanes PyramidBatch::planesOf(size_t light) const {
  PyramidPlanes planes;
  for (size_t i = 0; i < kPlanes; ++i) {
    planes.x[i] = planes_[i].x[light];
    planes.y[i] = planes_[i].y[light];
    planes.z[i] = planes_[i].z[light];
    planes.offset[i] = planes_[i].offset[light];
  }
  return planes;
}

PyramidBatch::Mask PyramidBatch::mayMeetEach(const BoxBatches& boxes, const Indices& which,
                                             Depths& depths) const {
  static_assert(sizeof(BoxBatch) == 6 * kLights * sizeof(float));
  const float* all = boxes.boxes()[0].centre[0].data();
  const hn::FixedTag<int32_t, kLights> ints;
  const auto box = hn::LoadU(ints, which.data());
  // 48 floats per batch of eight boxes.
  const auto lane = hn::And(box, hn::Set(ints, 7));
  const auto eights = hn::Sub(box, lane);
  const auto at = hn::Add(hn::Add(hn::ShiftLeft<2>(eights), hn::ShiftLeft<1>(eights)), lane);
  const auto take = [&](size_t i) { return hn::GatherIndex(kTag, all + i * kLights, at); };
  const SimdVec3<Vec> centre{take(0), take(1), take(2)}, half{take(3), take(4), take(5)};
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_)
    least =
        hn::Min(hn::Mul(depthOf(normalOf(p), load(p.offset), centre, half), load(p.weight)), least);
  hn::StoreU(least, kTag, depths.data());
  return all_ & inside(least);
}

PyramidBatch::Found PyramidBatch::find(size_t light, const BoxBatches& boxes, float enough) const {
  const auto depthsIn = [&](const BoxBatch& batch) {
    const SimdVec3<Vec> centre = load(batch.centre), half = load(batch.half);
    auto least = set(std::numeric_limits<float>::max());
    for (const Plane& p : planes_) {
      const SimdVec3<Vec> normal = set(vec3(p.x[light], p.y[light], p.z[light]));
      const auto depth = depthOf(normal, set(p.offset[light]), centre, half);
      least = hn::Min(hn::Mul(depth, set(p.weight[light])), least);
    }
    return least;
  };
  Found found{kNone, -std::numeric_limits<float>::max()};
  auto outside = set(found.depth);
  for (size_t a = 0; a < boxes.around().size(); ++a) {
    const auto around = depthsIn(boxes.around()[a]);
    const auto isOutside = hn::Lt(around, hn::Zero(kTag));
    outside = hn::Max(outside, hn::IfThenElse(isOutside, around, outside));
    alignas(32) std::array<float, kLights> most;  // upper bound of the depth of the boxes inside
    hn::Store(around, kTag, most.data());
    for (uint32_t some = 0xff & ~bitsOf(isOutside); some != 0; some &= some - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(some));
      const size_t batch = a * kLights + lane;
      if (batch >= boxes.boxes().size()) break;
      if (most[lane] <= found.depth) continue;
      const auto depths = depthsIn(boxes.boxes()[batch]);
      const auto deepest = hn::MaxOfLanes(kTag, depths);
      if (hn::GetLane(deepest) <= found.depth) continue;
      const auto first = static_cast<size_t>(std::countr_zero(bitsOf(hn::Eq(depths, deepest))));
      // The last batch repeats its last box.
      const size_t box = std::min(batch * kLights + first, boxes.size() - 1);
      found = {static_cast<int>(box), hn::GetLane(deepest)};
      if (found.depth >= enough) return found;
    }
  }
  if (found.depth >= 0.0f) return found;
  return {kNone, std::max(found.depth, hn::GetLane(hn::MaxOfLanes(kTag, outside)))};
}

}  // namespace lamplighter
