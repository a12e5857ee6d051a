// Light that the camera sees itself: the sky and lamps, behind the bars of windows and beside
// edges.
#pragma once

#include <cstdint>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

inline constexpr uint32_t kSeenRays = 8;

// What kSeenRays rays through a pixel meet.
struct SeenLight {
  vec3 radiance{0.0f};    // of the sky and of emissive surfaces [W/(m² sr)]
  float surfaces = 0.0f;  // the share of rays that meet a surface
  vec2 onSurface{0.5f};   // the point in the pixel of one of these, chosen at random
  bool isMixed = false;   // some rays meet surfaces that do not emit
};
// For sample number `sample` of pixel (x, y). The radiance plus `surfaces` times that of a path
// through `onSurface` which leaves out what the camera itself sees (PathTracerOptions::seesLights)
// is an unbiased estimate of the pixel. The points of consecutive samples are stratified. Depends
// only on its arguments.
SeenLight seenLight(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                    const View& view, int x, int y, uint32_t sample, uint32_t seed);

}  // namespace lamplighter
