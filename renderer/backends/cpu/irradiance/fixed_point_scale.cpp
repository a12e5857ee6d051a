#include "renderer/backends/cpu/irradiance/fixed_point_scale.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "renderer/backends/cpu/irradiance/simd_light.h"

namespace lamplighter::cpu {
namespace {

constexpr float kMostSum = 0x1p30f;  // units
constexpr size_t kManyLights = 1024;

// Lights that give less than a unit at this distance [m] are dim. Rounding takes at most half a
// unit of each, which can be seen if they are many.
constexpr float kDimDistance = 8.0f;
constexpr ptrdiff_t kFewDimLights = 32;

// With a clamp below this distance [m], a light can give a point next to it far more than any other
// point. A unit for the sum of such maxima would be too coarse.
constexpr float kFineClamp = 0.25f;

float brightestOf(const LightRecord& light) {
  return std::max({light.intensity.r, light.intensity.g, light.intensity.b});
}

// Point-like lights, padded to whole vectors.
struct PointLights {
  std::vector<float> x, y, z, brightest, mostWeight;

  PointLights(std::span<const LightRecord> lights, float clampDistance2) {
    for (const LightRecord& light : lights) {
      if (light.kind == LightRecord::Kind::directional) continue;
      x.push_back(light.position.x);
      y.push_back(light.position.y);
      z.push_back(light.position.z);
      brightest.push_back(brightestOf(light));
      mostWeight.push_back(cpu::mostWeight(light.kind, clampDistance2));
    }
    const size_t whole = (x.size() + kLanes - 1) / kLanes * kLanes;
    for (auto* v : {&x, &y, &z, &brightest, &mostWeight}) v->resize(whole, 0.0f);
  }

  // Upper bound of the sum of all lights at any point [W/m²].
  float mostAnywhere() const {
    float most = 0.0f;
    for (size_t i = 0; i < x.size(); ++i) most += brightest[i] * mostWeight[i];
    return most;
  }

  // Upper bound at points whose nearest light is i. Any other light is at least half of its
  // distance from light i away, so it gives at most four times its irradiance at light i.
  float mostNear(size_t i) const {
    Floats sum = hn::Zero(kTag);
    for (size_t j = 0; j < x.size(); j += kLanes) {
      const auto load = [j](const std::vector<float>& v) { return hn::LoadU(kTag, &v[j]); };
      const Floats dx = hn::Sub(load(x), broadcast(x[i])), dy = hn::Sub(load(y), broadcast(y[i])),
                   dz = hn::Sub(load(z), broadcast(z[i]));
      const Floats d2 = dot({dx, dy, dz}, {dx, dy, dz});
      const Floats weight = hn::Min(load(mostWeight), hn::Div(broadcast(4.0f), d2));
      sum = hn::MulAdd(load(brightest), weight, sum);
    }
    return hn::GetLane(hn::SumOfLanes(kTag, sum));
  }
};

float mostOfPoints(std::span<const LightRecord> lights, float clampDistance2) {
  const PointLights points(lights, clampDistance2);
  if (clampDistance2 >= kFineClamp * kFineClamp) return points.mostAnywhere();
  float most = 0.0f;
  for (size_t i = 0; i < points.x.size(); ++i) most = std::max(most, points.mostNear(i));
  return 1.001f * most;  // for rounding
}

}  // namespace

bool needFineSums(std::span<const LightRecord> lights, float unitsPerIrradiance) {
  const auto isDim = [&](const LightRecord& light) {
    const float brightest = brightestOf(light);
    const bool isParallel = light.kind == LightRecord::Kind::directional;
    const float distance2 = isParallel ? 1.0f : kDimDistance * kDimDistance;
    return brightest > 0.0f && brightest * unitsPerIrradiance < distance2;
  };
  return lights.size() > kManyLights || std::ranges::count_if(lights, isDim) > kFewDimLights;
}

// The squares of a directional light do not overlap, so only one square per direction counts.
float unitsPerIrradiance(std::span<const LightRecord> lights, float clampDistance2) {
  float most = mostOfPoints(lights, clampDistance2);
  std::map<std::array<float, 3>, float> parallel;
  for (const LightRecord& light : lights) {
    if (light.kind != LightRecord::Kind::directional) continue;
    float& square = parallel[{light.normal.x, light.normal.y, light.normal.z}];
    square = std::max(square, brightestOf(light));
  }
  for (const auto& [direction, square] : parallel) most += square;
  if (!(most > 0.0f) || !std::isfinite(most)) return 1.0f;
  return std::ldexp(1.0f, std::clamp(std::ilogb(kMostSum / most), -100, 100));
}

}  // namespace lamplighter::cpu
