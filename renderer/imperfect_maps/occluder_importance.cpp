#include "renderer/imperfect_maps/occluder_importance.h"

#include <algorithm>
#include <bit>

#include <tbb/parallel_for.h>

#include "renderer/imperfect_maps/solid_angle.h"

namespace lamplighter {
namespace {

constexpr uint32_t kPositionSet = 0x0cc1;
constexpr size_t kWeightsAStep = 256;
// Distance, in radii of the group, below which the solid angle is computed triangle by triangle.
constexpr float kNearRadii = 2.0f;
// Planes that contain a position: parts of the distance to the farthest corner of the triangle, and
// of the distance of the position from the origin.
constexpr float kInPlane = 1e-3f, kRounding = 4e-6f;

using WordTag = hn::FixedTag<uint32_t, 8>;
using Words8 = hn::Vec<WordTag>;
constexpr WordTag kWordTag;

HWY_INLINE Words8 mixedStep(Words8 x) {
  return hn::Add(hn::Mul(x, hn::Set(kWordTag, 1664525u)), hn::Set(kWordTag, 1013904223u));
}

// hash4() of random.h per lane.
HWY_INLINE Words8 hash4Lanes(Words8 x, Words8 y, Words8 z, Words8 w) {
  x = mixedStep(x);
  y = mixedStep(y);
  z = mixedStep(z);
  w = mixedStep(w);
  const auto add = [](Words8& to, Words8 a, Words8 b) { to = hn::Add(to, hn::Mul(a, b)); };
  const auto fold = [](Words8& v) { v = hn::Xor(v, hn::ShiftRight<16>(v)); };
  add(x, y, w);
  add(y, z, x);
  add(z, x, y);
  add(w, y, z);
  fold(x);
  fold(y);
  fold(z);
  fold(w);
  add(x, y, w);
  add(y, z, x);
  add(z, x, y);
  add(w, y, z);
  return x;
}

// Chooses a position per lane: of one of 8 parts of a list, or of 4 parts of each of two lists.
class PositionLanes {
 public:
  PositionLanes(size_t view, size_t lights, uint32_t seed) : seed_(seed) {
    const size_t lanes = view > 0 && lights > 0 ? 4 : 8;  // of a list
    for (size_t i = 0; i < 8; ++i) {
      const bool isOfLights = view == 0 || i >= lanes;
      const size_t first = isOfLights ? view : 0, count = isOfLights ? lights : view;
      first_[i] = static_cast<int32_t>(first);
      last_[i] = static_cast<int32_t>(first + count - 1);
      part_[i] = static_cast<float>(i % lanes);
      size_[i] = static_cast<float>(count) / static_cast<float>(lanes);
    }
  }

  HWY_INLINE Ints8 of(uint32_t group) const {
    const hn::FixedTag<int32_t, 8> ints;
    const Words8 bits = hash4Lanes(hn::Set(kWordTag, group), hn::Iota(kWordTag, 0u),
                                   hn::Set(kWordTag, seed_), hn::Set(kWordTag, kPositionSet));
    const Floats8 u = hn::Mul(hn::ConvertTo(kTag, hn::BitCast(ints, hn::ShiftRight<8>(bits))),
                              broadcast(0x1p-24f));
    const Floats8 place = hn::Mul(hn::Add(hn::Load(kTag, part_), u), hn::Load(kTag, size_));
    return hn::Min(hn::Add(hn::Load(ints, first_), truncateToInts(place)), hn::Load(ints, last_));
  }

 private:
  alignas(32) int32_t first_[8], last_[8];
  alignas(32) float part_[8], size_[8];
  uint32_t seed_;
};

// Where the position is in the plane of the triangle, up to rounding or a small part of the
// distance to its farthest corner.
HWY_INLINE hn::Mask<FloatTag> isInPlane(const SimdVec3<Floats8>& at, const SimdVec3<Floats8>& a,
                                        const SimdVec3<Floats8>& b, const SimdVec3<Floats8>& c) {
  const SimdVec3<Floats8> p = a - at, q = b - at, r = c - at, normal = cross(b - a, c - a);
  const Floats8 volume = dotFused(p, normal);
  const Floats8 reach = hn::Max(hn::Max(dotFused(p, p), dotFused(q, q)), dotFused(r, r));
  const Floats8 allowed = hn::MulAdd(broadcast(kInPlane * kInPlane), reach,
                                     hn::Mul(broadcast(kRounding * kRounding), dotFused(at, at)));
  return hn::Le(hn::Mul(volume, volume), hn::Mul(dotFused(normal, normal), allowed));
}

// The sum of those of all triangles that can be blockers.
HWY_INLINE Floats8 exactSolidAngle(const RenderScene& scene, const OccluderGroups& groups,
                                   const OccluderGroup& group, const SimdVec3<Floats8>& at) {
  const uint32_t* indices = &scene.indices[scene.objects[group.object].firstIndex];
  Floats8 sum = broadcast(0.0f);
  for (const OccluderTriangle& t : groups.trianglesOf(group)) {
    const uint32_t* corner = indices + size_t{3} * t.triangle;
    const auto a = broadcast(scene.positions[corner[0]]), b = broadcast(scene.positions[corner[1]]),
               c = broadcast(scene.positions[corner[2]]);
    sum = hn::Add(sum, hn::IfThenZeroElse(isInPlane(at, a, b, c), solidAngle8(at, a, b, c)));
  }
  return sum;
}

// √(A ωᵀ M ω)/d². `d`: from the positions to the centre; `square`: d².
HWY_INLINE Floats8 farSolidAngle(const OccluderGroup& group, const SimdVec3<Floats8>& d,
                                 Floats8 square) {
  const Floats8 plain =
      dotFused(broadcast(group.facing), {hn::Mul(d.x, d.x), hn::Mul(d.y, d.y), hn::Mul(d.z, d.z)});
  const Floats8 mixed = dotFused(broadcast(group.facingMixed),
                                 {hn::Mul(d.y, d.z), hn::Mul(d.z, d.x), hn::Mul(d.x, d.y)});
  const Floats8 facing = hn::Max(hn::MulAdd(broadcast(2.0f), mixed, plain), broadcast(0.0f));
  const Floats8 inverse = hn::Div(broadcast(1.0f), square);
  const Floats8 projected = hn::Sqrt(hn::Mul(hn::Mul(facing, broadcast(group.area)), inverse));
  return hn::Mul(projected, inverse);
}

HWY_INLINE float meanSolidAngle(const RenderScene& scene, const OccluderGroups& groups,
                                const OccluderGroup& group, const SimdVec3<Floats8>& at) {
  if (!(group.area > 0.0f)) return 0.0f;
  const SimdVec3<Floats8> d = broadcast(group.centre) - at;
  const Floats8 square = dotFused(d, d);
  const float reach = kNearRadii * group.radius;
  const bool isExact = group.count == 1 || bitsOf(hn::Le(square, broadcast(reach * reach))) != 0;
  const Floats8 angles =
      isExact ? exactSolidAngle(scene, groups, group, at) : farSolidAngle(group, d, square);
  return hn::GetLane(hn::SumOfLanes(kTag, angles)) / float{OccluderImportance::kPositions};
}

}  // namespace

void OccluderImportance::update(const RenderScene& scene, const OccluderGroups& groups,
                                std::span<const vec3> viewPositions,
                                std::span<const vec3> lightPositions,
                                const OccluderImportanceOptions& options) {
  const std::span<const OccluderGroup> all = groups.groups();
  weights_.assign(all.size(), 0.0f);
  px_.clear();
  py_.clear();
  pz_.clear();
  for (const std::span<const vec3> list : {viewPositions, lightPositions}) {
    for (const vec3& p : list) {
      px_.push_back(p.x);
      py_.push_back(p.y);
      pz_.push_back(p.z);
    }
  }
  if (!px_.empty()) {
    const PositionLanes lanes(viewPositions.size(), lightPositions.size(), options.seed);
    tbb::parallel_for(size_t{0}, (all.size() + kWeightsAStep - 1) / kWeightsAStep,
                      [&](size_t step) {
                        const size_t end = std::min((step + 1) * kWeightsAStep, all.size());
                        for (size_t g = step * kWeightsAStep; g < end; ++g) {
                          const OccluderGroup& group = all[g];
                          const Ints8 i = lanes.of(static_cast<uint32_t>(g));
                          const SimdVec3<Floats8> at{hn::GatherIndex(kTag, px_.data(), i),
                                                     hn::GatherIndex(kTag, py_.data(), i),
                                                     hn::GatherIndex(kTag, pz_.data(), i)};
                          weights_[g] = meanSolidAngle(scene, groups, group, at);
                        }
                      });
  }
  sum(all, options.areaShare);
}

void OccluderImportance::sum(std::span<const OccluderGroup> groups, float areaShare) {
  double weight = 0.0, area = 0.0;
  for (size_t g = 0; g < groups.size(); ++g) {
    weight += static_cast<double>(weights_[g]);
    area += static_cast<double>(groups[g].area);
  }
  const double byArea = weight > 0.0 ? static_cast<double>(areaShare) : 1.0;
  const double perWeight = weight > 0.0 ? (1.0 - byArea) / weight : 0.0,
               perArea = area > 0.0 ? byArea / area : 0.0;
  ends_.resize(groups.size() + 1);
  ends_[0] = total_ = 0.0;
  size_t last = 0;
  for (size_t g = 0; g < groups.size(); ++g) {
    const double own = perWeight * static_cast<double>(weights_[g]) +
                       perArea * static_cast<double>(groups[g].area);
    ends_[g + 1] = total_ += own;
    if (ends_[g + 1] > ends_[g]) last = g;
  }
  // Where to look: the number of parts is a power of two, so that u·parts is exact.
  const size_t parts = std::bit_ceil(std::max<size_t>(groups.size(), 1));
  guide_.resize(parts + 1);
  size_t g = 0;
  for (size_t p = 0; p < parts; ++p) {
    const double start = static_cast<double>(p) / static_cast<double>(parts) * total_;
    while (g < last && ends_[g + 1] <= start) ++g;
    guide_[p] = static_cast<uint32_t>(g);
  }
  guide_[parts] = static_cast<uint32_t>(last);
}

OccluderImportance::Choice OccluderImportance::at(double u) const {
  const auto part = static_cast<size_t>(u * static_cast<double>(guide_.size() - 1));
  const double place = u * total_;
  // The first group that ends behind the place. The last one of the part if rounding gives none.
  const auto from = ends_.begin() + 1 + guide_[part], to = ends_.begin() + 1 + guide_[part + 1];
  const auto end = std::upper_bound(from, to, place);
  const double start = *(end - 1);
  const double within = std::clamp((place - start) / (*end - start), 0.0, 0x1.fffffffffffffp-1);
  return {static_cast<uint32_t>(end - ends_.begin() - 1), within};
}

size_t OccluderImportance::memoryBytes() const {
  return (px_.capacity() + py_.capacity() + pz_.capacity() + weights_.capacity()) * sizeof(float) +
         ends_.capacity() * sizeof(double) + guide_.capacity() * sizeof(uint32_t);
}

}  // namespace lamplighter
