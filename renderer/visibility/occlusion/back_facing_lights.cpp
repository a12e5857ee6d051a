#include "renderer/visibility/occlusion/back_facing_lights.h"

#include "renderer/base/simd.h"
#include "renderer/visibility/occlusion/packet_math.h"

namespace lamplighter {

using namespace lanes;

BackFacingLights::BackFacingLights(const LightPacket& lights, const PatchRegion& region) {
  const Vec3 apex = load(lights.position), towards = load(lights.normal);
  const Vec margin = hn::Max(load(lights.rounding), set(region.rounding));
  const Vec slab = hn::Add(set(region.thickness), margin);
  const Vec behind = hn::Neg(hn::Add(set(region.thickness), hn::Mul(set(kSumsRounding), margin)));

  auto isBehind = hn::Le(dot(set(region.corners[0]) - apex, towards), behind);
  for (const vec3& corner : region.points().subspan(1))
    isBehind = hn::And(isBehind, hn::Le(dot(set(corner) - apex, towards), behind));
  if (region.isBox()) {
    dark = lights.all() & bitsOf(isBehind);
    const Vec3 low = set(region.corners[0]), high = set(region.corners[7]);
    const auto isWithin = [&](Vec at, Vec from, Vec to) {
      return hn::And(hn::Ge(at, hn::Sub(from, margin)), hn::Le(at, hn::Add(to, margin)));
    };
    degenerate =
        lights.all() & ~dark &
        bitsOf(hn::And(isWithin(apex.x, low.x, high.x),
                       hn::And(isWithin(apex.y, low.y, high.y), isWithin(apex.z, low.z, high.z))));
    return;
  }

  const vec3 middle = region.middle();
  const Vec3 way = apex - set(middle);
  const Vec height = dot(way, set(region.normal));
  if (region.frontOnly) {
    Vec least = behind;
    if (region.chart != kNone) {
      const Vec turned = hn::Add(hn::Sqrt(dot(way, way)), set(region.radius));
      least = hn::Sub(behind, hn::Mul(turned, set(kRoughSine)));
    }
    isBehind = hn::Or(isBehind, hn::Le(height, least));
  }
  dark = lights.all() & bitsOf(isBehind);
  degenerate = lights.all() & ~dark & bitsOf(hn::Le(hn::Abs(height), hn::Mul(set(4.0f), slab)));
}

}  // namespace lamplighter
