#include "renderer/light_maps/accumulate.h"

#include <algorithm>
#include <limits>
#include <vector>

#include "renderer/wide.h"

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr size_t kLanes = 8;
using Tag = hn::FixedTag<float, kLanes>;
using IntTag = hn::FixedTag<int32_t, kLanes>;
using HalfInts = hn::Half<IntTag>;
using DoubleTag = hn::FixedTag<double, kLanes / 2>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr DoubleTag kDoubleTag;

using Doubles = hn::Vec<DoubleTag>;
using Ints = hn::Vec<IntTag>;

// What several lights together may give to be summed in 32 bits [W/m²]: 2³⁰ units, of 2³¹.
constexpr float kMostInInts = 16.0f;
constexpr auto kUnitsPerIrradiance = static_cast<float>(1.0 / kIrradianceUnit);

HWY_INLINE Floats all(float v) { return hn::Set(kTag, v); }

HWY_INLINE Floats dot(Floats x, Floats y, Floats z, const vec3& v) {
  return hn::MulAdd(x, all(v.x), hn::MulAdd(y, all(v.y), hn::Mul(z, all(v.z))));
}

// The sums of one channel of eight texels.
class Sums {
 public:
  HWY_INLINE explicit Sums(const double* from)
      : low_(hn::LoadU(kDoubleTag, from)), high_(hn::LoadU(kDoubleTag, from + kLanes / 2)) {}
  HWY_INLINE void store(double* to) const {
    hn::StoreU(low_, kDoubleTag, to);
    hn::StoreU(high_, kDoubleTag, to + kLanes / 2);
  }
  HWY_INLINE void addRounded(Floats values) {
    const hn::Half<Tag> half;
    low_ = hn::Add(low_, rounded(hn::PromoteTo(kDoubleTag, hn::LowerHalf(half, values))));
    high_ = hn::Add(high_, rounded(hn::PromoteTo(kDoubleTag, hn::UpperHalf(half, values))));
  }
  HWY_INLINE void addUnits(Ints units) {
    const HalfInts half;
    const Doubles unit = hn::Set(kDoubleTag, kIrradianceUnit);
    low_ = hn::MulAdd(hn::PromoteTo(kDoubleTag, hn::LowerHalf(half, units)), unit, low_);
    high_ = hn::MulAdd(hn::PromoteTo(kDoubleTag, hn::UpperHalf(half, units)), unit, high_);
  }

 private:
  // A double beside this one is a multiple of kIrradianceUnit, so the sum with it is rounded to
  // one, ties to even, and the difference is exact.
  static HWY_INLINE Doubles rounded(Doubles values) {
    const Doubles large = hn::Set(kDoubleTag, 0x1.8p52 * kIrradianceUnit);
    return hn::Sub(hn::Add(values, large), large);
  }

  Doubles low_, high_;
};

// The light's irradiance at eight places relative to it [m⁻² × its intensity]. Whether there is
// any.
HWY_INLINE bool weigh(const TexelLight& light, const vec3& normal, Floats x, Floats y, Floats z,
                      Floats clamp2, Floats& weight) {
  const Floats zero = hn::Zero(kTag);
  if (light.kind == shared::kVplDirectional) {
    const Floats side = all(light.side), least = all(-light.side);
    const Floats qx = dot(x, y, z, light.tangent), qy = dot(x, y, z, light.bitangent);
    const auto within = hn::And(hn::And(hn::Ge(qx, least), hn::Lt(qx, side)),
                                hn::And(hn::Ge(qy, least), hn::Lt(qy, side)));
    weight = hn::IfThenElseZero(within, all(std::max(glm::dot(normal, light.axis), 0.0f)));
    return true;
  }
  const Floats height = dot(x, y, z, light.axis), s = dot(x, y, z, -normal);
  const auto lit = hn::And(hn::Gt(height, zero), hn::Gt(s, zero));
  if (hn::AllFalse(kTag, lit)) return false;
  const Floats d2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
  if (light.kind == shared::kVplCosine) {
    weight = hn::IfThenElseZero(lit, hn::Div(hn::Mul(s, height), hn::Mul(d2, hn::Max(d2, clamp2))));
    return true;
  }
  const Floats d = hn::Sqrt(d2);
  const Floats ramp = hn::MulAdd(hn::Div(height, d), all(light.coneScale), all(light.side));
  const Floats cone = hn::Min(hn::Max(ramp, zero), all(1.0f));
  weight = hn::IfThenElseZero(lit, hn::Mul(hn::Mul(cone, cone), hn::Div(s, hn::Mul(d2, d))));
  return true;
}

// A sphere about all texels.
struct Sphere {
  vec3 centre;
  float radius;

  explicit Sphere(const TexelPlaces& places) {
    vec3 least(std::numeric_limits<float>::infinity()), most(-least);
    for (size_t i = 0; i < places.x.size(); ++i) {
      const vec3 p(places.x[i], places.y[i], places.z[i]);
      least = glm::min(least, p);
      most = glm::max(most, p);
    }
    centre = 0.5f * (least + most);
    radius = 0.5f * glm::distance(least, most);
  }
};

// No less than it can give a texel [W/m²].
float mostOf(const TexelLight& light, const Sphere& texels, float clampDistance) {
  const vec3 channels = glm::abs(light.intensity);
  const float brightest = std::max({channels.r, channels.g, channels.b});
  if (light.kind == shared::kVplDirectional) return brightest;
  // A thousandth for rounding.
  float nearest = 0.999f * glm::distance(light.position, texels.centre) - 1.001f * texels.radius;
  nearest = std::max(nearest, light.kind == shared::kVplCosine ? clampDistance : 0.0f);
  return 1.001f * brightest / (nearest * nearest);
}

// Lights that are summed one after the other, `isFaint`: in 32 bits.
struct Run {
  size_t first, last;
  bool isFaint;
};

// Puts the faint ones first, in runs of which none gives too much.
std::vector<Run> divide(std::span<const TexelLight*> lights, const TexelPlaces& places,
                        float clampDistance) {
  const Sphere texels(places);
  std::vector<Run> runs;
  size_t faint = 0;
  float sum = 0.0f;
  for (size_t i = 0; i < lights.size(); ++i) {
    const float most = mostOf(*lights[i], texels, clampDistance);
    if (!(most <= kMostInInts)) continue;
    sum += most;
    if (runs.empty() || sum > kMostInInts) {
      runs.push_back({faint, faint, true});
      sum = most;
    }
    std::swap(lights[faint], lights[i]);
    runs.back().last = ++faint;
  }
  if (faint < lights.size()) runs.push_back({faint, lights.size(), false});
  return runs;
}

// Three channels of eight texels.
struct PacketSums {
  Sums r, g, b;
};

struct Packet {
  Floats x, y, z;

  HWY_INLINE bool weigh(const TexelLight& light, const vec3& normal, Floats clamp2,
                        Floats& weight) const {
    return lamplighter::weigh(light, normal, hn::Sub(x, all(light.position.x)),
                              hn::Sub(y, all(light.position.y)), hn::Sub(z, all(light.position.z)),
                              clamp2, weight);
  }
};

HWY_INLINE void addFaint(std::span<const TexelLight* const> lights, const Packet& at,
                         const vec3& normal, Floats clamp2, PacketSums& sums) {
  Ints r = hn::Zero(IntTag()), g = r, b = r;
  for (const TexelLight* light : lights) {
    Floats weight;
    if (!at.weigh(*light, normal, clamp2, weight)) continue;
    const vec3& units = light->units;
    r = hn::Add(r, roundToInts(hn::Mul(weight, all(units.r))));
    g = hn::Add(g, roundToInts(hn::Mul(weight, all(units.g))));
    b = hn::Add(b, roundToInts(hn::Mul(weight, all(units.b))));
  }
  sums.r.addUnits(r);
  sums.g.addUnits(g);
  sums.b.addUnits(b);
}

HWY_INLINE void addBright(std::span<const TexelLight* const> lights, const Packet& at,
                          const vec3& normal, Floats clamp2, PacketSums& sums) {
  for (const TexelLight* light : lights) {
    Floats weight;
    if (!at.weigh(*light, normal, clamp2, weight)) continue;
    sums.r.addRounded(hn::Mul(weight, all(light->intensity.r)));
    sums.g.addRounded(hn::Mul(weight, all(light->intensity.g)));
    sums.b.addRounded(hn::Mul(weight, all(light->intensity.b)));
  }
}

}  // namespace

TexelLight::TexelLight(const shared::Vpl& vpl, float sign)
    : kind(vpl.position.w),
      position(vpl.position),
      axis(vpl.normal),
      tangent(vpl.tangent),
      bitangent(glm::cross(axis, tangent)),
      intensity(sign * vec3(vpl.intensity)),
      units(kUnitsPerIrradiance * intensity),
      coneScale(vpl.normal.w),
      side(vpl.tangent.w) {}

void accumulate(std::span<const TexelLight*> lights, const TexelPlaces& places, float clampDistance,
                double* r, double* g, double* b) {
  const std::vector<Run> runs = divide(lights, places, clampDistance);
  const Floats clamp2 = all(clampDistance * clampDistance);
  for (size_t i = 0; i < places.x.size(); i += kLanes) {
    const Packet at{hn::LoadU(kTag, &places.x[i]), hn::LoadU(kTag, &places.y[i]),
                    hn::LoadU(kTag, &places.z[i])};
    // All lights one after the other, so that the sums stay in registers.
    PacketSums sums{Sums(r + i), Sums(g + i), Sums(b + i)};
    for (const Run& run : runs) {
      const auto some = lights.subspan(run.first, run.last - run.first);
      if (run.isFaint)
        addFaint(some, at, places.normal, clamp2, sums);
      else
        addBright(some, at, places.normal, clamp2, sums);
    }
    sums.r.store(r + i);
    sums.g.store(g + i);
    sums.b.store(b + i);
  }
}

}  // namespace lamplighter
