// Converts the options of ManyLights for sums of light.
#pragma once

#include "renderer/light_maps/light_proxies.h"
#include "renderer/methods/gi_method.h"
#include "renderer/methods/many_lights/options.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

inline shared::ShadingParams shadingOf(const ManyLightsOptions& options, bool isHasty) {
  return {vec4(options.clampDistance, options.shadowBias, 0.0f,
               static_cast<float>(options.lightsPerPass)),
          vec4(static_cast<float>(options.block), isHasty ? 1.0f : 0.0f, 0.0f, 0.0f),
          vec4(options.speculars ? 1.0f : 0.0f, options.leastRoughness, 0.0f, 0.0f)};
}

// With fewer VPLs no groups are used: each VPL matters, including faint ones where there is no
// other light.
inline constexpr int kFewestForGroups = 800;

inline LightProxies::Groups groupsOf(const FrameInputs& in, float share, int vpls) {
  return {vpls < kFewestForGroups ? 0.0f : share,
          [&rays = in.services.rays()](const vec3& a, const vec3& b) {
            return !rays.occluded({a, 0.0f, b - a, 1.0f});
          },
          in.changes.surfaces()};
}

}  // namespace lamplighter
