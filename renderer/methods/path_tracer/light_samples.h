// Direct light at a point of a path: samples of emitters, and their MIS weights against directions
// that hit an emitter by chance.
#pragma once

#include "renderer/base/low_discrepancy.h"
#include "renderer/methods/path_tracer/local_surface.h"
#include "renderer/sampling/emitters/lights.h"

namespace lamplighter {

class LightSamples {
 public:
  // Keeps references to its arguments.
  LightSamples(const RenderScene& scene, const RayCaster& rays, const LightSet& lights)
      : scene_(scene), rays_(rays), lights_(lights) {}

  // Direct light from emitters, times f · cos: one sample of all emissive surfaces, one of all
  // punctual lights, one of the sky. A constant sky is not sampled here, because the
  // cosine-distributed bounce directions already sample it optimally.
  vec3 direct(const LocalSurface& at, PathSampler& sampler);
  // Emission of a surface that a ray from a point hit, with the MIS weight against direct().
  // `pdfDirection`: density per solid angle with which the point chose the direction; 0 for the
  // camera, which does not compete with light sampling.
  vec3 emissionSeen(const Hit& hit, const Surface& surface, const vec3& direction, const vec3& from,
                    float pdfDirection) const;
  // The radiance of the sky for a ray that hits nothing, with the MIS weight against direct().
  vec3 skySeen(const vec3& direction, float pdfDirection) const;

  // Light of an emissive surface, times f · cos, from its sample u. `w`: receives the unit vector
  // towards the sample.
  vec3 fromSurface(const LocalSurface& at, int emitter, vec2 u, vec3& w);
  vec3 fromSky(const LocalSurface& at, vec2 u, vec3& w);
  // The same for one punctual light.
  vec3 fromPunctual(const LocalSurface& at, const RenderPunctual& light, vec3& w);

  uint64_t raysTraced() const { return raysTraced_; }

 private:
  vec3 fromPunctuals(const LocalSurface& at, float u);
  bool visible(const LocalSurface& at, const vec3& direction, float distance);
  bool visible(const LocalSurface& at, const EmitterPoint& p, const vec3& toLight);

  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  uint64_t raysTraced_ = 0;
};

}  // namespace lamplighter
