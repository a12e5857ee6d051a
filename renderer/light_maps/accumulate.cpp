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

HWY_INLINE Floats all(float v) { return hn::Set(kTag, v); }

// Four of the eight values, times the sign and rounded, into their sums.
HWY_INLINE void addRounded(hn::Vec<hn::Half<Tag>> values, hn::Vec<DoubleTag> unitsPerValue,
                           double* sums) {
  const auto units = hn::Round(hn::Mul(hn::PromoteTo(kDoubleTag, values), unitsPerValue));
  const auto unit = hn::Set(kDoubleTag, kIrradianceUnit);
  hn::StoreU(hn::MulAdd(units, unit, hn::LoadU(kDoubleTag, sums)), kDoubleTag, sums);
}

HWY_INLINE void addRounded(Floats values, hn::Vec<DoubleTag> unitsPerValue, size_t count,
                           double* sums) {
  if (count == kLanes) {
    addRounded(hn::LowerHalf(hn::Half<Tag>(), values), unitsPerValue, sums);
    addRounded(hn::UpperHalf(hn::Half<Tag>(), values), unitsPerValue, sums + kLanes / 2);
    return;
  }
  double last[kLanes] = {};
  std::copy_n(sums, count, last);
  addRounded(hn::LowerHalf(hn::Half<Tag>(), values), unitsPerValue, last);
  addRounded(hn::UpperHalf(hn::Half<Tag>(), values), unitsPerValue, last + kLanes / 2);
  std::copy_n(last, count, sums);
}

}  // namespace

void accumulate(const shared::Vpl& vpl, const TexelPlaces& places, float clampDistance, double sign,
                size_t count, double* r, double* g, double* b) {
  const auto dot = [](Floats ax, Floats ay, Floats az, const vec3& v) {
    return hn::MulAdd(ax, all(v.x), hn::MulAdd(ay, all(v.y), hn::Mul(az, all(v.z))));
  };
  const vec3 position(vpl.position), axis(vpl.normal), tangent(vpl.tangent);
  const vec3 bitangent = glm::cross(axis, tangent);
  const bool isDirectional = vpl.position.w == shared::kVplDirectional;
  const bool isCosine = vpl.position.w == shared::kVplCosine;
  const Floats zero = hn::Zero(kTag), clamp2 = all(clampDistance * clampDistance);
  const auto units = hn::Set(kDoubleTag, sign / kIrradianceUnit);
  for (size_t i = 0; i < count; i += kLanes) {
    const Floats x = hn::Sub(hn::LoadU(kTag, &places.x[i]), all(position.x));
    const Floats y = hn::Sub(hn::LoadU(kTag, &places.y[i]), all(position.y));
    const Floats z = hn::Sub(hn::LoadU(kTag, &places.z[i]), all(position.z));
    Floats weight;
    if (isDirectional) {
      const Floats side = all(vpl.tangent.w), least = all(-vpl.tangent.w);
      const Floats qx = dot(x, y, z, tangent), qy = dot(x, y, z, bitangent);
      const auto within = hn::And(hn::And(hn::Ge(qx, least), hn::Lt(qx, side)),
                                  hn::And(hn::Ge(qy, least), hn::Lt(qy, side)));
      weight = hn::IfThenElseZero(within, all(std::max(glm::dot(places.normal, axis), 0.0f)));
    } else {
      const Floats height = dot(x, y, z, axis), s = dot(x, y, z, -places.normal);
      const auto lit = hn::And(hn::Gt(height, zero), hn::Gt(s, zero));
      if (hn::AllFalse(kTag, lit)) continue;
      const Floats d2 = hn::MulAdd(x, x, hn::MulAdd(y, y, hn::Mul(z, z)));
      if (isCosine) {
        weight = hn::Div(hn::Mul(s, height), hn::Mul(d2, hn::Max(d2, clamp2)));
      } else {
        const Floats d = hn::Sqrt(d2);
        const Floats ramp = hn::MulAdd(hn::Div(height, d), all(vpl.normal.w), all(vpl.tangent.w));
        const Floats cone = hn::Min(hn::Max(ramp, zero), all(1.0f));
        weight = hn::Mul(hn::Mul(cone, cone), hn::Div(s, hn::Mul(d2, d)));
      }
      weight = hn::IfThenElseZero(lit, weight);
    }
    const size_t here = std::min(kLanes, count - i);
    addRounded(hn::Mul(weight, all(vpl.intensity.r)), units, here, r + i);
    addRounded(hn::Mul(weight, all(vpl.intensity.g)), units, here, g + i);
    addRounded(hn::Mul(weight, all(vpl.intensity.b)), units, here, b + i);
  }
}

}  // namespace lamplighter
