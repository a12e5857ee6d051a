// Light that the camera sees itself: the sky and lamps, behind the bars of windows and beside
// edges.
#pragma once

#include <cstdint>

#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

inline constexpr uint32_t kSeenRays = 8;

struct SeenLight {
  vec3 radiance{0.0f};   // [W/(m² sr)]
  bool isMixed = false;  // there are surfaces that do not emit, too
};
// An unbiased estimate of the light of the sky and of emissive surfaces in pixel (x, y), from
// sample number `sample`: by kSeenRays rays, which are far cheaper than paths. The points in the
// pixel of consecutive samples are stratified. Depends only on its arguments.
SeenLight seenLight(const RenderScene& scene, const RayCaster& caster, const View& view, int x,
                    int y, uint32_t sample, uint32_t seed);

}  // namespace lamplighter
