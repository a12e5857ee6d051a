#define HWY_DISABLE_PCLMUL_AES 1  // see pyramid_sides.h

#include "renderer/visibility/pyramid_batch.h"

#include <algorithm>
#include <bit>
#include <limits>

#include "renderer/raycast/ray_caster.h"
#include "renderer/visibility/pyramid_sides.h"

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr size_t kLanes = PyramidBatch::kLights;
using Tag = hn::FixedTag<float, kLanes>;
constexpr Tag kTag;
using Vec = hn::Vec<Tag>;

Vec set(float v) { return hn::Set(kTag, v); }
Lanes3<Vec> set(const vec3& v) { return {set(v.x), set(v.y), set(v.z)}; }

Vec load(const std::array<float, kLanes>& v) { return hn::Load(kTag, v.data()); }
Lanes3<Vec> load(const std::array<std::array<float, kLanes>, 3>& v) {
  return {load(v[0]), load(v[1]), load(v[2])};
}
template <typename Plane>
Lanes3<Vec> normalOf(const Plane& p) {
  return {load(p.x), load(p.y), load(p.z)};
}

// As glm adds it up, so that it is the same bits.
Vec dot(const Lanes3<Vec>& a, const Lanes3<Vec>& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}

uint32_t bitsOf(hn::Mask<Tag> mask) {
  uint8_t bits[8] = {};
  hn::StoreMaskBits(kTag, mask, bits);
  return bits[0];
}

// By how much boxes are inside of planes, as OcclusionPyramid::mayMeet() adds it up.
Vec depthOf(const Lanes3<Vec>& normal, Vec offset, const Lanes3<Vec>& centre,
            const Lanes3<Vec>& half) {
  auto farthest = hn::MulAdd(normal.x, centre.x, offset);
  farthest = hn::MulAdd(normal.y, centre.y, farthest);
  farthest = hn::MulAdd(normal.z, centre.z, farthest);
  farthest = hn::MulAdd(hn::Abs(normal.x), half.x, farthest);
  farthest = hn::MulAdd(hn::Abs(normal.y), half.y, farthest);
  return hn::MulAdd(hn::Abs(normal.z), half.z, farthest);
}

// Keeps those of the planes; which are inside of all.
uint32_t take(Vec depths, PyramidBatch::Depths& out) {
  hn::StoreU(depths, kTag, out.data());
  return 0xff & ~bitsOf(hn::Lt(depths, hn::Zero(kTag)));
}

}  // namespace

void BoxBatch::set(size_t i, const Bounds& box) {
  const vec3 middle = box.centre(), extent = 0.5f * box.extent();
  for (int c = 0; c < 3; ++c) {
    centre[static_cast<size_t>(c)][i] = middle[c];
    half[static_cast<size_t>(c)][i] = extent[c];
  }
}

// The last is filled up with its last box.
BoxBatches::BoxBatches(std::span<const Bounds> boxes) {
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
  for (const Bounds& b : around) bounds_.add(b);
  around_ = batchesOf(around);
}

PyramidApex::PyramidApex(const shared::Vpl& vpl)
    : position(vpl.position), normal(vpl.normal), rounding(rayEpsilon(position)) {}

PyramidBatch::PyramidBatch(std::span<const PyramidApex* const> lights, const PatchRegion& region)
    : all_((Mask{1} << lights.size()) - 1) {
  alignas(32) Lanes px, py, pz, nx, ny, nz, rounding;
  for (size_t i = 0; i < kLights; ++i) {
    const PyramidApex& light = *lights[i < lights.size() ? i : 0];
    px[i] = light.position.x;
    py[i] = light.position.y;
    pz[i] = light.position.z;
    nx[i] = light.normal.x;
    ny[i] = light.normal.y;
    nz[i] = light.normal.z;
    rounding[i] = light.rounding;
  }
  const Lanes3<Vec> apex{load(px), load(py), load(pz)}, towards{load(nx), load(ny), load(nz)};
  const auto margin = hn::Max(load(rounding), set(region.rounding));
  const auto store = [&](Plane& plane, const Lanes3<Vec>& normal, Vec offset) {
    hn::Store(normal.x, kTag, plane.x.data());
    hn::Store(normal.y, kTag, plane.y.data());
    hn::Store(normal.z, kTag, plane.z.data());
    hn::Store(offset, kTag, plane.offset.data());
  };
  store(planes_[0], towards, hn::Sub(hn::Neg(margin), dot(towards, apex)));

  const vec3 middle = 0.5f * (region.corners[0] + region.corners[2]);
  const Lanes3<Vec> centre = set(middle), normal = set(region.normal);
  const auto height = dot(
      {hn::Sub(apex.x, centre.x), hn::Sub(apex.y, centre.y), hn::Sub(apex.z, centre.z)}, normal);
  const auto above = hn::Gt(height, hn::Zero(kTag));
  const auto turn = [&](Vec v) { return hn::IfThenElse(above, v, hn::Neg(v)); };
  const Lanes3<Vec> up{turn(normal.x), turn(normal.y), turn(normal.z)};
  const auto thickness = set(region.thickness);
  const auto slab = hn::Add(thickness, margin);
  const auto slack = region.chart != kNone ? slab : hn::Mul(set(-3.0f), slab);
  store(planes_[1], up, hn::Sub(slack, dot(up, centre)));

  for (size_t i = 0; i < 4; ++i) {
    const auto at = [&](const auto& v) { return set(vec3(v[0][i], v[1][i], v[2][i])); };
    const Lanes3<Vec> from = at(region.from);
    const Lanes3<Vec> way{hn::Sub(from.x, apex.x), hn::Sub(from.y, apex.y),
                          hn::Sub(from.z, apex.z)};
    const SidePlanes<Vec> side =
        sidePlanes(kTag, from, at(region.sides), way, centre, up, thickness, margin, false);
    store(planes_[2 + i], side.normal, side.offset);
  }
}

PyramidBatch::Mask PyramidBatch::mayMeet(const Bounds& box, Depths& depths) const {
  const Lanes3<Vec> centre = set(box.centre()), half = set(0.5f * box.extent());
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_)
    least = hn::Min(depthOf(normalOf(p), load(p.offset), centre, half), least);
  return all_ & take(least, depths);
}

PyramidBatch::Mask PyramidBatch::mayMeetSphere(const vec3& centre, float radius,
                                               Depths& depths) const {
  auto least = set(std::numeric_limits<float>::max());
  for (const Plane& p : planes_) {
    auto distance = hn::MulAdd(load(p.x), set(centre.x), load(p.offset));
    distance = hn::MulAdd(load(p.y), set(centre.y), distance);
    distance = hn::MulAdd(load(p.z), set(centre.z), distance);
    least = hn::Min(distance, least);
  }
  const Mask met = all_ & ~bitsOf(hn::Lt(least, set(-radius)));
  hn::StoreU(hn::Add(least, set(radius)), kTag, depths.data());
  return met;
}

PyramidBatch::Found PyramidBatch::find(size_t light, const BoxBatches& boxes, size_t first) const {
  const auto depthsIn = [&](const BoxBatch& batch) {
    const Lanes3<Vec> centre = load(batch.centre), half = load(batch.half);
    auto least = set(std::numeric_limits<float>::max());
    for (const Plane& p : planes_) {
      const Lanes3<Vec> normal = set(vec3(p.x[light], p.y[light], p.z[light]));
      least = hn::Min(depthOf(normal, set(p.offset[light]), centre, half), least);
    }
    return least;
  };
  const auto zero = hn::Zero(kTag);
  const auto found = [&](size_t batch, Vec depths) {
    return Found{static_cast<int>(batch), hn::GetLane(hn::MaxOfLanes(kTag, depths))};
  };
  auto outside = set(-std::numeric_limits<float>::max());
  if (first < boxes.size()) {
    const auto depths = depthsIn(boxes.boxes()[first]);
    if (!hn::AllTrue(kTag, hn::Lt(depths, zero))) return found(first, depths);
    outside = depths;
  }
  for (size_t a = 0; a < boxes.around().size(); ++a) {
    const auto around = depthsIn(boxes.around()[a]);
    const auto isOutside = hn::Lt(around, zero);
    outside = hn::Max(outside, hn::IfThenElse(isOutside, around, outside));
    for (uint32_t some = 0xff & ~bitsOf(isOutside); some != 0; some &= some - 1) {
      const size_t batch = a * kLanes + static_cast<size_t>(std::countr_zero(some));
      if (batch >= boxes.size()) break;
      if (batch == first) continue;
      const auto depths = depthsIn(boxes.boxes()[batch]);
      if (!hn::AllTrue(kTag, hn::Lt(depths, zero))) return found(batch, depths);
      outside = hn::Max(outside, depths);
    }
  }
  return {kNone, hn::GetLane(hn::MaxOfLanes(kTag, outside))};
}

}  // namespace lamplighter
