#include "renderer/visibility/movers/shadow_volumes.h"

#include <bit>
#include <limits>

#include "renderer/visibility/occlusion/cone_lanes.h"

namespace lamplighter {
ShadowVolumeX8::ShadowVolumeX8() { nearest_.fill(std::numeric_limits<float>::infinity()); }

void ShadowVolumeX8::set(size_t lane, const ShadowVolume::Cone& cone) {
  for (int c = 0; c < 3; ++c) {
    apex_[static_cast<size_t>(c)][lane] = cone.apex[c];
    axis_[static_cast<size_t>(c)][lane] = cone.axis[c];
  }
  nearest_[lane] = cone.nearest;
  sine_[lane] = cone.sine;
  cosine_[lane] = cone.cosine;
  before_[lane] = cone.before;
  radius_[lane] = cone.radius;
}

uint32_t ShadowVolumeX8::mayFallOn(const vec3& centre, float radius) const {
  const ConeLanes<FloatTag> lanes{load(apex_), load(axis_), load(nearest_), load(sine_),
                                  load(cosine_)};
  return conesMayFallOn(lanes, centre, radius);
}

// Shrinks the sphere of the caster: if the smaller shadow reaches the target, so does that of a
// moved sphere of the old size that contains the smaller one. Only the sine changes, by the
// reduction of the radius divided by the distance; the cosine grows by less than the tangent times
// that.
void ShadowVolumeX8::slack(const vec3& centre, float radius, Lanes& out) const {
  const Floats8 zero = hn::Zero(kTag), sine = load(sine_), cosine = load(cosine_);
  const Floats8 nearest = load(nearest_), before = load(before_), size = load(radius_);
  const SimdVec3<Floats8> v = broadcast(centre) - load(apex_);
  const Floats8 distance2 = dotFused(v, v), along = dotFused(v, load(axis_));
  const Floats8 across = hn::Sqrt(hn::Max(hn::NegMulAdd(along, along, distance2), zero));
  const Floats8 inside = hn::NegMulAdd(across, cosine, hn::MulAdd(along, sine, broadcast(radius)));
  const Floats8 sideways = hn::Div(hn::Mul(inside, hn::Mul(hn::Add(nearest, size), cosine)),
                                   hn::MulAdd(along, cosine, hn::Mul(across, sine)));
  const Floats8 past = hn::Sub(hn::Add(hn::Sqrt(distance2), broadcast(radius)), nearest);
  const Floats8 ofCone = hn::Min(hn::Min(sideways, past), hn::Min(before, size));
  const Floats8 least = hn::IfThenElseZero(hn::Gt(along, zero), ofCone);
  // The caster surrounds the light: the shadow is everywhere.
  const auto isAround = hn::Lt(nearest, broadcast(-std::numeric_limits<float>::max()));
  hn::Store(hn::Max(hn::IfThenElse(isAround, before, least), zero), kTag, out.data());
}

uint64_t ShadowVolumes::mayFallOn(size_t word, uint64_t wanted, const vec3& centre,
                                  float radius) const {
  constexpr size_t kLanes = ShadowVolumeX8::kLanes;
  constexpr uint64_t kAll = (uint64_t{1} << kLanes) - 1;
  uint64_t mask = 0;
  for (uint64_t rest = wanted; rest != 0;) {
    const size_t first = static_cast<size_t>(std::countr_zero(rest)) / kLanes * kLanes;
    rest &= ~(kAll << first);
    mask |= uint64_t{groups_[(64 * word + first) / kLanes].mayFallOn(centre, radius)} << first;
  }
  return wanted & mask;
}

}  // namespace lamplighter
