// Finds the lights that need no pyramid for a patch.
#pragma once

#include "renderer/patches/topology.h"
#include "renderer/visibility/occlusion/light_lanes.h"
#include "renderer/visibility/occlusion/plane_lanes.h"

namespace lamplighter {

struct BackFacingLights {
  // No point of the patch is in front of the light, or the light is behind all visible points.
  LightMask dark = 0;
  // The light is so close to the patch or its plane that pyramids are not reliable; only lights
  // that are not dark.
  LightMask degenerate = 0;

  template <typename Tag>
  BackFacingLights(const LightLanes<Tag>& lights, const PatchRegion& region) {
    constexpr float kLeastCosine = 1e-4f;  // between a patch and a parallel light
    const Tag tag;
    const auto set = [&](const auto& v) { return setLanes(tag, v); };
    const auto slab = hn::Add(set(region.thickness), lights.margin);
    // Patch points further behind the planes than rounding errors get exactly no light
    // (vplGeometry), not just little.
    const auto behind =
        hn::Neg(hn::Add(set(region.thickness), hn::Mul(set(kSumsRounding), lights.margin)));

    if (!lights.isParallel) {
      dark = lights.all;
      for (const vec3& corner : region.points()) {
        const auto height = dotUnfused(set(corner) - lights.apex, lights.towards);
        dark &= bitsOf(tag, hn::Le(height, behind));
        if (dark == 0) break;
      }
    }
    if (!region.isBox()) {
      const auto way = wayFrom(region.middle(), lights);
      const auto height = dotUnfused(way, set(region.normal));
      if (region.frontOnly) {
        auto least = lights.isParallel ? set(-kLeastCosine) : behind;
        // The bumps of a rough patch may face the light before the patch does.
        if (region.chart != kNone) {
          const auto turned = lights.isParallel
                                  ? set(1.0f)
                                  : hn::Add(hn::Sqrt(dotUnfused(way, way)), set(region.radius));
          least = hn::Sub(least, hn::Mul(turned, set(kRoughSine)));
        }
        dark |= lights.all & bitsOf(tag, hn::Le(height, least));
      }
      const auto tooLow = lights.isParallel ? set(kLeastCosine) : hn::Mul(set(4.0f), slab);
      degenerate = lights.all & ~dark & bitsOf(tag, hn::Le(hn::Abs(height), tooLow));
    } else if (!lights.isParallel) {
      const auto low = set(region.corners[0]), high = set(region.corners[7]);
      const auto isWithin = [&](auto at, auto from, auto to) {
        return hn::And(hn::Ge(at, hn::Sub(from, lights.margin)),
                       hn::Le(at, hn::Add(to, lights.margin)));
      };
      const auto isInside = hn::And(
          isWithin(lights.apex.x, low.x, high.x),
          hn::And(isWithin(lights.apex.y, low.y, high.y), isWithin(lights.apex.z, low.z, high.z)));
      degenerate = lights.all & ~dark & bitsOf(tag, isInside);
    }
  }
};

}  // namespace lamplighter
