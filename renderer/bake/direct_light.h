// Direct light at a surface point, with exact shadows.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_light/blockers.h"
#include "renderer/surface_light/emitter_factor.h"

namespace lamplighter {

// Irradiance by light samples [W/m²]: by all of them, and by those visible from the place.
struct SampledLight {
  vec3 all{0.0f}, visible{0.0f};
};
// One ray for each sample. `clampDistance`: bound on 1/d² [m]; none: the form factor of a disk with
// the area that the sample represents.
SampledLight sampledLight(const RayCaster& rays, std::span<const SceneVpl> samples,
                          const ReceivingPlace& at, std::optional<float> clampDistance);

// A punctual light needs one ray. An untextured surface of few triangles has its form factor in
// closed form, multiplied by the visible share: by a mask of the flat light, or by light samples;
// by rays from the place if the light covers much of its hemisphere. Other lights are the sum of
// their samples.
class DirectLight {
 public:
  struct Options {
    int samples = 300;  // of all lights together
    int mask = 0;       // side of the bit mask of a flat light; 0: light samples
    uint32_t seed = 1;
  };
  // Keeps references to the arguments.
  DirectLight(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
              const Options& options);

  vec3 irradiance(const ReceivingPlace& at) const;  // [W/m²]

 private:
  struct Light {
    EmitterFactor factor;
    std::optional<FlatLight> flat;  // if it has one colour
    size_t first = 0, count = 0;    // of samples_
  };
  float visibleShare(const Light& light, float factor, const SurfaceSpot& spot,
                     const ReceivingPlace& at) const;
  float nearShare(const FlatLight& light, const SurfaceSpot& spot) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  Options options_;
  std::vector<SceneVpl> samples_;  // at the brightness of the scene, by emitter
  std::vector<Light> emitters_;    // as in lights_
  Blockers blockers_;
};

}  // namespace lamplighter
