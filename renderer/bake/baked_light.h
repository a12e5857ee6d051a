// Irradiance at surface points: from the settled VPLs with exact shadows, or from the path-traced
// reference.
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
  float clampDistance = 0.5f;  // settled: bound on 1/d² of a VPL [m]
  PathTracerOptions paths;     // reference
  int samples = 64;            // reference: paths per texel
};

class BakedLight {
 public:
  BakedLight(const RenderScene& scene, const RayCaster& rays, const BakeLightOptions& options);

  // Mean irradiance [W/m²] over the points of one texel. Ignores the normal map, which is finer
  // than texels. Points inside other objects do not count. If all points are inside, the result is
  // negative, which means unknown. `texel` is the index among all texels. The result depends only
  // on the arguments.
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
