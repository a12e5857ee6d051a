// Light that the camera sees directly: the sky and lamps, for example behind the bars of windows.
#pragma once

#include <cstdint>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

inline constexpr uint32_t kSeenRays = 8;

// The hits of kSeenRays rays through a pixel.
struct SeenLight {
  vec3 radiance{0.0f};    // of the sky and emissive surfaces [W/(m² sr)]
  float surfaces = 0.0f;  // share of rays that hit a surface
  vec2 onSurface{0.5f};   // the point in the pixel of one of these rays, chosen at random
  bool isMixed = false;   // some rays hit surfaces that do not emit
};
// For sample number `sample` of pixel (x, y). The radiance, plus `surfaces` times the radiance of a
// path through `onSurface` without light that the camera sees directly
// (PathTracerOptions::seesLights) is an unbiased estimate of the pixel. The points of consecutive
// samples are stratified. Depends only on its arguments.
SeenLight seenLight(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                    const View& view, int x, int y, uint32_t sample, uint32_t seed);

}  // namespace lamplighter
