// The irradiance at points of surfaces: of the settled light samples with exact shadows, or of the
// path-traced reference.
#pragma once

#include <span>
#include <vector>

#include "renderer/bake/bake_points.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

struct BakeLightOptions {
  bool reference = false;
  VplCounts counts;            // settled
  float clampDistance = 0.5f;  // settled: bounds 1/d² of light samples [m]
  PathTracerOptions paths;     // reference
  int samples = 64;            // reference: paths a texel
};

class BakedLight {
 public:
  BakedLight(const RenderScene& scene, const RayCaster& rays, const BakeLightOptions& options);

  // The mean irradiance [W/m²] over the points of one texel, without the normal map: that is finer
  // than texels. Points inside of another object do not count; negative where all are: then nothing
  // is known. `texel` numbers it among all texels. A function of its arguments alone.
  vec3 irradiance(std::span<const BakePoint> points, uint32_t texel) const;

 private:
  ReceivingPlace placeOf(const BakePoint& point) const;
  bool isBuried(const ReceivingPlace& at, uint32_t texel) const;
  vec3 ofSamples(const ReceivingPlace& at) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  BakeLightOptions options_;
  LightSet lights_;
  std::vector<SceneVpl> vpls_;
};

}  // namespace lamplighter
