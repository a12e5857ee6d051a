// x86-64-v3 has no AES instructions, which Highway wants of its AVX2 target unless told otherwise.
#define HWY_DISABLE_PCLMUL_AES 1

#include "renderer/light_maps/accumulate.h"

#include <algorithm>

#include <hwy/highway.h>

namespace lamplighter {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
constexpr size_t kLanes = 8;
using Tag = hn::FixedTag<float, kLanes>;
using DoubleTag = hn::FixedTag<double, kLanes / 2>;
using Floats = hn::Vec<Tag>;
constexpr Tag kTag;
constexpr DoubleTag kDoubleTag;

using Doubles = hn::Vec<DoubleTag>;

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

}  // namespace

TexelLight::TexelLight(const shared::Vpl& vpl, float sign)
    : kind(vpl.position.w),
      position(vpl.position),
      axis(vpl.normal),
      tangent(vpl.tangent),
      bitangent(glm::cross(axis, tangent)),
      intensity(sign * vec3(vpl.intensity)),
      coneScale(vpl.normal.w),
      side(vpl.tangent.w) {}

void accumulate(std::span<const TexelLight* const> lights, const TexelPlaces& places,
                float clampDistance, double* r, double* g, double* b) {
  const Floats clamp2 = all(clampDistance * clampDistance);
  for (size_t i = 0; i < places.x.size(); i += kLanes) {
    const Floats x = hn::LoadU(kTag, &places.x[i]), y = hn::LoadU(kTag, &places.y[i]),
                 z = hn::LoadU(kTag, &places.z[i]);
    // All lights one after the other, so that the sums stay in registers.
    Sums red(r + i), green(g + i), blue(b + i);
    for (const TexelLight* light : lights) {
      const vec3& from = light->position;
      Floats weight;
      if (!weigh(*light, places.normal, hn::Sub(x, all(from.x)), hn::Sub(y, all(from.y)),
                 hn::Sub(z, all(from.z)), clamp2, weight))
        continue;
      red.addRounded(hn::Mul(weight, all(light->intensity.r)));
      green.addRounded(hn::Mul(weight, all(light->intensity.g)));
      blue.addRounded(hn::Mul(weight, all(light->intensity.b)));
    }
    red.store(r + i);
    green.store(g + i);
    blue.store(b + i);
  }
}

}  // namespace lamplighter
