#include "renderer/light_maps/accumulate.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "renderer/light_maps/texel_sums.h"

namespace lamplighter {
namespace {

using namespace texels;

// Upper bound of the irradiance of several lights that are summed in 32 bits [W/m²]: 2³⁰ units, of
// 2³¹.
constexpr float kMostInInts = 16.0f;
constexpr auto kUnitsPerIrradiance = static_cast<float>(1.0 / kIrradianceUnit);

// The positions of eight texels, as in TexelPlaces.
struct Packet {
  Floats u, w;
};

// Cosine-weighted point-like lights (almost all lights are of this kind) over the plane of a tile.
// In the coordinates of the plane, most terms are equal for all texels. Structure of arrays.
class PlaneLights {
 public:
  PlaneLights(std::span<const SummedLight* const> lights, const TexelPlaces& places,
              float clampDistance);

  // Adds to several packets at once, which share the loads of a light.
  template <size_t kPackets>
  void add(const Packet* at, PacketSums* sums) const;

 private:
  // Lights that are summed one after another.
  struct Run {
    size_t first, last;  // indices into order_
  };
  enum Value : size_t {
    kU,  // of its projection onto the plane [m]
    kW,
    kHeight2,  // its height over the plane, squared [m²]
    // Height of a texel over the light's own plane, from its distance to the projection.
    kAxisU,
    kAxisW,
    kAxisHeight,
    kRed,  // intensity times its height over the plane; for faint lights in units
    kGreen,
    kBlue,
    kMost,  // upper bound of its irradiance at a texel [W/m²]
    kValues
  };

  void setEight(std::span<const SummedLight* const> lights, size_t first,
                const TexelPlaces& places);
  void divide(size_t count);
  HWY_INLINE Floats weigh(const float* light, const Packet& at) const;

  float clamp2_;
  std::vector<float> values_;    // eight lights side by side, one value after another
  std::vector<uint32_t> order_;  // index of the first value of each light
  // Faint lights, in runs whose sum fits 32 bits; then all other lights.
  std::vector<Run> faint_;
  Run bright_;
};

PlaneLights::PlaneLights(std::span<const SummedLight* const> lights, const TexelPlaces& places,
                         float clampDistance)
    : clamp2_(clampDistance * clampDistance),
      values_((lights.size() + kLanes - 1) / kLanes * kLanes * kValues) {
  for (size_t i = 0; i < lights.size(); i += kLanes) setEight(lights, i, places);
  divide(lights.size());
}

void PlaneLights::setEight(std::span<const SummedLight* const> lights, size_t first,
                           const TexelPlaces& places) {
  enum From : size_t { kPosition, kAxis = 3, kIntensity = 6, kFrom = 9 };
  alignas(32) float from[kFrom][kLanes];
  for (size_t lane = 0; lane < kLanes; ++lane) {
    const SummedLight& light = *lights[std::min(first + lane, lights.size() - 1)];
    for (int c = 0; c < 3; ++c) {
      const auto i = static_cast<size_t>(c);
      from[kPosition + i][lane] = light.position[c] - places.origin[c];
      from[kAxis + i][lane] = light.axis[c];
      from[kIntensity + i][lane] = light.intensity[c];
    }
  }
  const auto dot = [&](From v, const vec3& axis) {
    return hn::MulAdd(hn::Load(kTag, from[v]), broadcast(axis.x),
                      hn::MulAdd(hn::Load(kTag, from[v + 1]), broadcast(axis.y),
                                 hn::Mul(hn::Load(kTag, from[v + 2]), broadcast(axis.z))));
  };
  const auto store = [&](Value value, Floats v) {
    hn::StoreU(v, kTag, &values_[first * kValues + value * kLanes]);
  };
  const Floats zero = hn::Zero(kTag);
  const Floats u = dot(kPosition, places.tangent), w = dot(kPosition, places.bitangent);
  const Floats height = dot(kPosition, places.normal), height2 = hn::Mul(height, height);
  store(kU, u);
  store(kW, w);
  store(kHeight2, height2);
  store(kAxisU, dot(kAxis, places.tangent));
  store(kAxisW, dot(kAxis, places.bitangent));
  store(kAxisHeight, hn::Neg(hn::Mul(height, dot(kAxis, places.normal))));
  const auto isAbove = hn::And(hn::Gt(height, zero), hn::Gt(height2, zero));
  Floats brightest = zero;
  for (size_t c = 0; c < 3; ++c) {
    const Floats channel = hn::Load(kTag, from[kIntensity + c]);
    brightest = hn::Max(brightest, hn::Abs(channel));
    store(static_cast<Value>(kRed + c), hn::IfThenElseZero(isAbove, hn::Mul(height, channel)));
  }
  const auto beside = [&](Floats foot, float least, float most) {
    return hn::Max(hn::Max(hn::Sub(broadcast(least), foot), hn::Sub(foot, broadcast(most))), zero);
  };
  const Floats besideU = beside(u, places.min.x, places.max.x),
               besideW = beside(w, places.min.y, places.max.y);
  const Floats nearest2 = hn::MulAdd(besideU, besideU, hn::MulAdd(besideW, besideW, height2));
  // 0.1% tolerance for rounding, on both bounds.
  const Floats least = hn::Max(hn::Mul(nearest2, broadcast(0.999f)), broadcast(clamp2_));
  store(kMost, hn::IfThenElseZero(isAbove, hn::Div(hn::Mul(brightest, broadcast(1.001f)), least)));
}

// Lights without contribution are skipped.
void PlaneLights::divide(size_t count) {
  order_.resize(count);
  size_t faint = 0, bright = count;  // from both ends
  float sum = 0.0f;
  for (size_t i = 0; i < count; ++i) {
    const size_t light = i / kLanes * kLanes * kValues + i % kLanes;
    const float most = values_[light + kMost * kLanes];
    if (most == 0.0f) continue;
    if (!(most <= kMostInInts)) {
      order_[--bright] = static_cast<uint32_t>(light);
      continue;
    }
    sum += most;
    if (faint_.empty() || sum > kMostInInts) {
      faint_.push_back({faint, faint});
      sum = most;
    }
    for (const Value channel : {kRed, kGreen, kBlue})
      values_[light + channel * kLanes] *= kUnitsPerIrradiance;
    order_[faint++] = static_cast<uint32_t>(light);
    faint_.back().last = faint;
  }
  bright_ = {bright, count};
}

// The irradiance of a light whose values begin here [m⁻³ × its intensity times its height].
HWY_INLINE Floats PlaneLights::weigh(const float* light, const Packet& at) const {
  const auto value = [&](Value v) { return broadcast(light[v * kLanes]); };
  const Floats du = hn::Sub(at.u, value(kU)), dw = hn::Sub(at.w, value(kW));
  const Floats height =
      hn::MulAdd(du, value(kAxisU), hn::MulAdd(dw, value(kAxisW), value(kAxisHeight)));
  const Floats d2 = hn::MulAdd(du, du, hn::MulAdd(dw, dw, value(kHeight2)));
  return hn::Div(hn::Max(height, hn::Zero(kTag)), hn::Mul(d2, hn::Max(d2, broadcast(clamp2_))));
}

template <size_t kPackets>
void PlaneLights::add(const Packet* at, PacketSums* sums) const {
  for (const Run& run : faint_) {
    Ints r[kPackets], g[kPackets], b[kPackets];
#pragma GCC unroll 2
    for (size_t p = 0; p < kPackets; ++p) r[p] = g[p] = b[p] = hn::Zero(IntTag());
    for (size_t i = run.first; i < run.last; ++i) {
      const float* const light = &values_[order_[i]];
      const Floats red = broadcast(light[kRed * kLanes]), green = broadcast(light[kGreen * kLanes]),
                   blue = broadcast(light[kBlue * kLanes]);
#pragma GCC unroll 2
      for (size_t p = 0; p < kPackets; ++p) {
        const Floats weight = weigh(light, at[p]);
        r[p] = hn::Add(r[p], roundToInts(hn::Mul(weight, red)));
        g[p] = hn::Add(g[p], roundToInts(hn::Mul(weight, green)));
        b[p] = hn::Add(b[p], roundToInts(hn::Mul(weight, blue)));
      }
    }
#pragma GCC unroll 2
    for (size_t p = 0; p < kPackets; ++p) {
      sums[p].r.addUnits(r[p]);
      sums[p].g.addUnits(g[p]);
      sums[p].b.addUnits(b[p]);
    }
  }
  for (size_t i = bright_.first; i < bright_.last; ++i) {
    const float* const light = &values_[order_[i]];
#pragma GCC unroll 2
    for (size_t p = 0; p < kPackets; ++p)
      sums[p].addRounded(weigh(light, at[p]), light[kRed * kLanes], light[kGreen * kLanes],
                         light[kBlue * kLanes]);
  }
}

// The irradiance of any other light [m⁻² × its intensity; directional: 1].
Floats weigh(const SummedLight& light, const TexelPlaces& places, const Packet& at) {
  const Floats zero = hn::Zero(kTag);
  const vec3 v = places.origin - light.position;
  // Distance from the light along an axis.
  const auto along = [&](const vec3& axis) {
    return hn::MulAdd(at.u, broadcast(glm::dot(axis, places.tangent)),
                      hn::MulAdd(at.w, broadcast(glm::dot(axis, places.bitangent)),
                                 broadcast(glm::dot(axis, v))));
  };
  if (light.kind == shared::kVplDirectional) {
    const Floats side = broadcast(light.side), least = broadcast(-light.side);
    const Floats x = along(light.tangent), y = along(light.bitangent);
    const auto within = hn::And(hn::And(hn::Ge(x, least), hn::Lt(x, side)),
                                hn::And(hn::Ge(y, least), hn::Lt(y, side)));
    const float cosine = std::max(glm::dot(places.normal, light.axis), 0.0f);
    return hn::IfThenElseZero(within, broadcast(cosine));
  }
  const float s = -glm::dot(places.normal, v);
  if (!(s > 0.0f)) return zero;
  const Floats x = along(places.tangent), y = along(places.bitangent), z = along(light.axis);
  const Floats d2 = hn::MulAdd(x, x, hn::MulAdd(y, y, broadcast(s * s))), d = hn::Sqrt(d2);
  const Floats ramp = hn::MulAdd(hn::Div(z, d), broadcast(light.coneScale), broadcast(light.side));
  const Floats cone = hn::Min(hn::Max(ramp, zero), broadcast(1.0f));
  return hn::IfThenElseZero(hn::Gt(z, zero),
                            hn::Mul(hn::Mul(cone, cone), hn::Div(broadcast(s), hn::Mul(d2, d))));
}

}  // namespace

SummedLight::SummedLight(const shared::Vpl& vpl, float sign)
    : kind(vpl.position.w),
      position(vpl.position),
      axis(vpl.normal),
      tangent(vpl.tangent),
      bitangent(glm::cross(axis, tangent)),
      intensity(sign * vpl.intensity),
      coneScale(vpl.normal.w),
      side(vpl.tangent.w) {}

void accumulate(std::span<const SummedLight* const> lights, const TexelPlaces& places,
                float clampDistance, double* r, double* g, double* b) {
  std::vector<const SummedLight*> cosine, others;
  cosine.reserve(lights.size());
  for (const SummedLight* light : lights)
    (light->kind == shared::kVplCosine ? cosine : others).push_back(light);
  const PlaneLights over(cosine, places, clampDistance);
  // Processes all lights in one loop, so that the sums stay in registers.
  const auto addTo = [&]<size_t kPackets>(size_t first) {
    const auto all = [&](auto&& f) {
      return [&]<size_t... p>(std::index_sequence<p...>) {
        return std::array{f(first + p * kLanes)...};
      }
      (std::make_index_sequence<kPackets>());
    };
    const auto at = all([&](size_t i) {
      return Packet{hn::LoadU(kTag, &places.u[i]), hn::LoadU(kTag, &places.w[i])};
    });
    auto sums = all([&](size_t i) { return PacketSums{Sums(r + i), Sums(g + i), Sums(b + i)}; });
    over.add<kPackets>(at.data(), sums.data());
    for (size_t p = 0; p < kPackets; ++p) {
      for (const SummedLight* light : others) {
        const vec3& i = light->intensity;
        sums[p].addRounded(weigh(*light, places, at[p]), i.r, i.g, i.b);
      }
      const size_t i = first + p * kLanes;
      sums[p].r.store(r + i);
      sums[p].g.store(g + i);
      sums[p].b.store(b + i);
    }
  };
  size_t i = 0;
  for (; i + 2 * kLanes <= places.u.size(); i += 2 * kLanes) addTo.template operator()<2>(i);
  if (i < places.u.size()) addTo.template operator()<1>(i);
}

void readSums(const double* r, const double* g, const double* b, std::span<vec4> out) {
  const hn::FixedTag<float, kLanes / 2> half;
  const auto load = [&](const double* from) {
    return hn::DemoteTo(half, hn::LoadU(kDoubleTag, from));
  };
  for (size_t i = 0; i < out.size(); i += kLanes / 2)
    hn::StoreInterleaved4(load(r + i), load(g + i), load(b + i), hn::Zero(half), half, &out[i].x);
}

}  // namespace lamplighter
