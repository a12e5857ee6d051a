#include "renderer/visibility/occlusion/pyramid_batch.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "renderer/visibility/occlusion/plane_lanes.h"

namespace lamplighter {
namespace {

using Vec = Floats8;

template <typename Plane>
HWY_INLINE PlaneLanes<Vec> planeOf(const Plane& p) {
  return {{load(p.x), load(p.y), load(p.z)}, load(p.offset)};
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
  const LightLanes<FloatTag> lanes = lanesOf(lights, region);
  hn::Store(lanes.margin, kTag, margin_.data());
  const auto store = [](Plane& to, const PlaneLanes<Vec>& plane) {
    hn::Store(plane.normal.x, kTag, to.x.data());
    hn::Store(plane.normal.y, kTag, to.y.data());
    hn::Store(plane.normal.z, kTag, to.z.data());
    hn::Store(plane.offset, kTag, to.offset.data());
  };
  store(planes_[0], lightPlane(lanes));
  const PlaneLanes<Vec> patch = patchPlane(lanes, region);
  store(planes_[1], patch);
  const SimdVec3<Vec> middle = broadcast(region.middle());
  for (size_t i = 0; i < 4; ++i) {
    const auto at = [&](const auto& v) { return broadcast(vec3(v[0][i], v[1][i], v[2][i])); };
    const SimdVec3<Vec> from = at(region.from);
    store(planes_[2 + i],
          sidePlanes(kTag, from, at(region.sides), from - lanes.apex, middle, patch.normal,
                     broadcast(region.thickness), lanes.margin, false));
  }
}

// A shape that moves by a vector d approaches a plane with normal n by n·d. This is at most the
// larger of |n·axis| and |n×axis| / across, times the length of d in the metric.
void PyramidBatch::weighBy(const MotionMetric& metric) {
  const SimdVec3<Vec> axis = broadcast(metric.axis);
  const auto one = broadcast(1.0f), across = broadcast(1.0f / metric.across);
  for (Plane& p : planes_) {
    const SimdVec3<Vec> normal{load(p.x), load(p.y), load(p.z)};
    const auto along = dotUnfused(normal, axis), squared = dotUnfused(normal, normal);
    const auto sideways = hn::Sqrt(hn::Max(hn::NegMulAdd(along, along, squared), hn::Zero(kTag)));
    // A plane that is left out has the normal zero; nothing is outside it.
    const auto most =
        hn::Max(hn::Max(hn::Abs(along), hn::Mul(sideways, across)), broadcast(1e-20f));
    hn::Store(hn::Max(hn::Div(one, most), one), kTag, p.weight.data());
  }
}

LightMask PyramidBatch::mayMeetSphere(const vec3& centre, float radius, Depths& depths) const {
  auto least = broadcast(std::numeric_limits<float>::max());
  for (const Plane& p : planes_) {
    const auto depth = hn::Add(distanceOf(planeOf(p), broadcast(centre)), broadcast(radius));
    least = hn::Min(hn::Mul(depth, load(p.weight)), least);
  }
  hn::StoreU(least, kTag, depths.data());
  return all_ & inside(least);
}

LightMask PyramidBatch::mayMeet(const Bounds& box) const {
  const SimdVec3<Vec> centre = broadcast(box.centre()), half = broadcast(0.5f * box.extent());
  auto least = broadcast(std::numeric_limits<float>::max());
  for (const Plane& p : planes_) least = hn::Min(depthOf(planeOf(p), centre, half), least);
  return all_ & inside(least);
}

LightMask PyramidBatch::mayMeetSphere(const vec3& centre, float radius) const {
  auto least = broadcast(std::numeric_limits<float>::max());
  for (const Plane& p : planes_) least = hn::Min(distanceOf(planeOf(p), broadcast(centre)), least);
  return all_ & ~outside(hn::Add(least, broadcast(radius)));
}

LightMask PyramidBatch::hold(const vec3& point) const {
  const SimdVec3<Vec> p = broadcast(point);
  auto least = broadcast(std::numeric_limits<float>::max());
  for (const Plane& plane : planes_) least = hn::Min(distanceOf(planeOf(plane), p), least);
  return all_ & bitsOf(hn::Ge(least, load(margin_)));
}

PyramidBatch::Met PyramidBatch::meets(const std::array<vec3, 3>& triangle) const {
  const SimdVec3<Vec> a = broadcast(triangle[0]), b = broadcast(triangle[1]),
                      c = broadcast(triangle[2]);
  auto leastA = broadcast(std::numeric_limits<float>::max()), leastB = leastA, leastC = leastA;
  auto leastOfMost = leastA;  // minimum over planes of the largest distance of a corner
  for (const Plane& p : planes_) {
    const PlaneLanes<Vec> plane = planeOf(p);
    const auto da = distanceOf(plane, a), db = distanceOf(plane, b), dc = distanceOf(plane, c);
    leastA = hn::Min(da, leastA);
    leastB = hn::Min(db, leastB);
    leastC = hn::Min(dc, leastC);
    leastOfMost = hn::Min(hn::Max(hn::Max(da, db), dc), leastOfMost);
  }
  const LightMask open = all_ & ~outside(leastOfMost);
  Met met;
  met.byCorner = {open & ~outside(leastA), open & ~outside(leastB), open & ~outside(leastC)};
  met.unsure = open & ~met.met();
  return met;
}

// A triangle that is not outside either of two planes may still be beyond their common edge: all of
// it is outside a third plane through that edge. This is so if for some positive factor the sum of
// one distance and the factor times the other is negative at each corner.
LightMask PyramidBatch::surelyMiss(const std::array<vec3, 3>& triangle, float rounding) const {
  const auto margin = hn::Mul(broadcast(2.0f), hn::Max(load(margin_), broadcast(rounding)));
  std::array<std::array<Vec, 3>, kPlanes> depths;
  for (size_t p = 1; p < kPlanes; ++p) {
    PlaneLanes<Vec> plane = planeOf(planes_[p]);
    plane.offset = hn::Add(plane.offset, margin);
    for (size_t i = 0; i < 3; ++i) depths[p][i] = distanceOf(plane, broadcast(triangle[i]));
  }
  const auto zero = hn::Zero(kTag);
  const auto isPastEdge = [&](const std::array<Vec, 3>& a, const std::array<Vec, 3>& b) {
    auto least = zero, most = broadcast(std::numeric_limits<float>::max());  // bounds of the factor
    for (size_t i = 0; i < 3; ++i) {
      const auto factor = hn::Div(hn::Neg(a[i]), b[i]);
      const auto isLower = hn::Lt(b[i], zero);
      least = hn::Max(hn::IfThenElseZero(isLower, factor), least);
      most = hn::Min(hn::IfThenElse(isLower, most, factor), most);
    }
    return hn::Lt(hn::Mul(least, broadcast(1.001f)), most);
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

LightMask PyramidBatch::mayMeetEach(const BoxBatches& boxes, const Indices& which,
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
  auto least = broadcast(std::numeric_limits<float>::max());
  for (const Plane& p : planes_)
    least = hn::Min(hn::Mul(depthOf(planeOf(p), centre, half), load(p.weight)), least);
  hn::StoreU(least, kTag, depths.data());
  return all_ & inside(least);
}

PyramidBatch::Found PyramidBatch::find(size_t light, const BoxBatches& boxes, float enough) const {
  const auto depthsIn = [&](const BoxBatch& batch) {
    const SimdVec3<Vec> centre = load(batch.centre), half = load(batch.half);
    auto least = broadcast(std::numeric_limits<float>::max());
    for (const Plane& p : planes_) {
      const PlaneLanes<Vec> plane{broadcast(vec3(p.x[light], p.y[light], p.z[light])),
                                  broadcast(p.offset[light])};
      const auto depth = depthOf(plane, centre, half);
      least = hn::Min(hn::Mul(depth, broadcast(p.weight[light])), least);
    }
    return least;
  };
  Found found{kNone, -std::numeric_limits<float>::max()};
  auto outside = broadcast(found.depth);
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
