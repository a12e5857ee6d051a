// The reference: a path tracer kept plain, so that it can be believed. It shares with the methods
// it judges only the scene, the rays and the list of lights.
#pragma once

#include "renderer/methods/light_part.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct PathTracerOptions {
  int bounces = 5;  // indirect bounces; 0: direct light only
  uint32_t seed = 1;
  bool lightOnly = false;  // what the camera sees is white; what it is lit by is not
  // What the camera sees reflects by metallic-roughness (shaders/shared/brdf.h), no less rough than
  // this; what light bounces off on its way there is Lambert's.
  bool speculars = false;
  float leastRoughness = 0.1f;
  // Both parts of a path are of the same random numbers, so that they add up to the whole.
  LightPart part = LightPart::all;

  bool operator==(const PathTracerOptions&) const = default;
};

// An unbiased estimate of the radiance [W/(m² sr)] that the pixel's box filter gathers: sample
// number `sample` of pixel (x, y). A function of its arguments alone. Adds to
// `raysTraced`, if given, how many rays that took.
vec3 tracePath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
               const View& view, int x, int y, uint32_t sample, const PathTracerOptions& options,
               uint64_t* raysTraced = nullptr);

// A point of a surface, on the side of its unit normal; a smooth surface has another shading
// normal.
struct ReceivingPlace {
  vec3 position{0.0f}, normal{0, 1, 0}, shadingNormal{0, 1, 0};
  uint32_t leftOutBy = 0;  // RenderObject::leftOutBy
};

// The same for the irradiance [W/m²] there. `bounces` counts what bounces before it arrives.
vec3 traceIrradiance(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                     const ReceivingPlace& place, uint32_t pixel, uint32_t sample,
                     const PathTracerOptions& options);

}  // namespace lamplighter
