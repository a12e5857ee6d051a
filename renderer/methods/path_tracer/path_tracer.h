// The reference: a simple path tracer that is easy to verify. It shares only the scene, the rays
// and the list of lights with the methods that are compared with it.
#pragma once

#include <array>
#include <optional>

#include "renderer/methods/light_part.h"
#include "renderer/methods/path_tracer/known_light.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct PathTracerOptions {
  int bounces = 5;  // indirect bounces; 0: direct light only
  uint32_t seed = 1;
  // surfaces seen by the camera are white; their illumination uses real albedos
  bool lightOnly = false;
  // Surfaces seen by the camera use metallic-roughness (shaders/shared/brdf.h) with at least this
  // roughness.
  bool speculars = false;
  float leastRoughness = 0.1f;
  // All other surfaces of a path use it, too. Off: they are Lambertian.
  bool glossyBounces = false;
  // Both parts use the same random numbers, so they add up to the whole.
  LightPart part = LightPart::all;
  // Russian roulette starts after this number of bounces; before it, no path is terminated.
  int sureBounces = 8;
  // Off: the sky and lamps that the camera itself sees are left out (seen_light.h).
  bool seesLights = true;
  // The point of the pixel through which camera rays go; none: random.
  std::optional<vec2> inPixel = {};

  bool operator==(const PathTracerOptions&) const = default;
};

// An unbiased estimate of the radiance [W/(m² sr)] of pixel (x, y) with a box filter, from sample
// number `sample`. Depends only on its arguments. Adds the number of rays to `raysTraced`, if
// given.
vec3 tracePath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
               const View& view, int x, int y, uint32_t sample, const PathTracerOptions& options,
               uint64_t* raysTraced = nullptr);

// An estimate by a path that ends at known light, and a correction for the error of that light. The
// expected value of radiance + missing equals that of tracePath().
struct EndedPath {
  vec3 radiance{0.0f}, missing{0.0f};
};
// `isWhole`: the path continues, to compute `missing`; otherwise `missing` is 0.
EndedPath traceEndedPath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                         const View& view, int x, int y, uint32_t sample,
                         const PathTracerOptions& options, const KnownLight& known, bool isWhole,
                         uint64_t* raysTraced = nullptr);

// A surface point on the side of its unit normal; a smooth surface has a separate shading normal.
struct ReceivingPlace {
  vec3 position{0.0f}, normal{0, 1, 0}, shadingNormal{0, 1, 0};
  uint32_t leftOutBy = 0;  // RenderObject::leftOutBy
};

// The same for the irradiance [W/m²] at a surface point. `bounces` counts the bounces before the
// light arrives.
vec3 traceIrradiance(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                     const ReceivingPlace& place, uint32_t pixel, uint32_t sample,
                     const PathTracerOptions& options);

// Light that arrives at a point of space: radiance times solid angle [W/m²], so that
// ∫ L(ω) f(ω) dω is estimated by the sum of light · f(towards).
struct ArrivingLight {
  vec3 towards{0, 0, 1};  // unit vector from the point to where the light comes from
  vec3 light{0.0f};
};
// An unbiased estimate of the light that arrives at a point of space, from sample number `sample`:
// along a direction with constant density over the sphere, from a point of an emissive surface, and
// from a direction of the sky, weighted by the balance heuristic. The directions of an aligned
// power of two of samples are stratified. Without punctual lights. Light linking is ignored.
// `bounces` counts the bounces before the light arrives. Depends only on its arguments.
std::array<ArrivingLight, 3> traceArrivingLight(const RenderScene& scene, const RayCaster& caster,
                                                const LightSet& lights, const vec3& position,
                                                uint32_t pixel, uint32_t sample,
                                                const PathTracerOptions& options);
// The light that arrives from a punctual light: exact, by one ray. 0 if it is hidden.
ArrivingLight arrivingPunctual(const RenderScene& scene, const RayCaster& caster,
                               const LightSet& lights, const vec3& position,
                               const RenderPunctual& light);

}  // namespace lamplighter
