#include "renderer/visibility/shadow_reaches.h"

#include <limits>

#include "renderer/wide.h"

namespace lamplighter {
namespace {

constexpr hn::FixedTag<float, ShadowReaches::kLanes> kTag;

}  // namespace

ShadowReaches::ShadowReaches(size_t count) : groups_((count + kLanes - 1) / kLanes) {
  for (Group& g : groups_) g.nearest.fill(std::numeric_limits<float>::infinity());
}

void ShadowReaches::set(size_t i, const ShadowReach& reach) {
  Group& g = groups_[i / kLanes];
  const size_t lane = i % kLanes;
  const ShadowReach::Cone cone = reach.cone();
  for (int c = 0; c < 3; ++c) {
    g.apex[static_cast<size_t>(c)][lane] = cone.apex[c];
    g.axis[static_cast<size_t>(c)][lane] = cone.axis[c];
  }
  g.nearest[lane] = cone.nearest;
  g.sine[lane] = cone.sine;
  g.cosine[lane] = cone.cosine;
}

// As ShadowReach::mayFallOn() adds it up.
HWY_INLINE uint32_t ShadowReaches::mayFallOn(const Group& g, const vec3& centre, float radius) {
  const auto load = [](const Lanes& lanes) { return hn::Load(kTag, lanes.data()); };
  const auto set = [](float v) { return hn::Set(kTag, v); };
  const auto dot = [](const auto& a, const auto& b) {
    return hn::Add(hn::Add(hn::Mul(a[0], b[0]), hn::Mul(a[1], b[1])), hn::Mul(a[2], b[2]));
  };
  using Vec = hn::Vec<decltype(kTag)>;
  const Vec zero = hn::Zero(kTag), sine = load(g.sine), cosine = load(g.cosine);
  Vec v[3], axis[3];
  for (int c = 0; c < 3; ++c) {
    v[c] = hn::Sub(set(centre[c]), load(g.apex[static_cast<size_t>(c)]));
    axis[c] = load(g.axis[static_cast<size_t>(c)]);
  }
  const Vec distance2 = dot(v, v), gap = hn::Sub(load(g.nearest), set(radius));
  const auto isNear = hn::And(hn::Gt(gap, zero), hn::Lt(distance2, hn::Mul(gap, gap)));
  const Vec along = dot(v, axis), along2 = hn::Mul(along, along);
  const Vec across2 = hn::Max(hn::Sub(distance2, along2), zero);
  const Vec cosine2 = hn::Mul(cosine, cosine);
  const auto isBehind = hn::And(
      hn::Lt(along, zero), hn::Le(hn::Mul(hn::Mul(across2, sine), sine), hn::Mul(along2, cosine2)));
  const Vec reach = hn::Add(set(radius), hn::Mul(along, sine));
  const auto isIn =
      hn::And(hn::Ge(reach, zero), hn::Le(hn::Mul(across2, cosine2), hn::Mul(reach, reach)));
  const auto isAround = hn::Le(distance2, set(radius * radius));
  uint8_t bits[8] = {};
  hn::StoreMaskBits(
      kTag, hn::AndNot(isNear, hn::Or(hn::And(isBehind, isAround), hn::AndNot(isBehind, isIn))),
      bits);
  return bits[0];
}

uint64_t ShadowReaches::mayFallOn(size_t word, uint64_t wanted, const vec3& centre,
                                  float radius) const {
  constexpr uint64_t kAll = (uint64_t{1} << kLanes) - 1;
  uint64_t mask = 0;
  for (size_t i = 0; i < 64; i += kLanes)
    if ((wanted >> i & kAll) != 0)
      mask |= uint64_t{mayFallOn(groups_[(64 * word + i) / kLanes], centre, radius)} << i;
  return wanted & mask;
}

}  // namespace lamplighter
