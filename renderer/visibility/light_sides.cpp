#include "renderer/visibility/light_sides.h"

#include "renderer/visibility/lane_sums.h"
#include "renderer/wide.h"

namespace lamplighter {

using namespace lanes;

LightSides::LightSides(const LightLanes& lights, const PatchRegion& region) {
  const Vec3 apex = load(lights.position), towards = load(lights.normal);
  const Vec margin = hn::Max(load(lights.rounding), set(region.rounding));
  const Vec slab = hn::Add(set(region.thickness), margin);
  const Vec behind = hn::Neg(hn::Add(set(region.thickness), hn::Mul(set(kSumsRounding), margin)));

  auto isBehind = hn::Le(dot(set(region.corners[0]) - apex, towards), behind);
  for (size_t i = 1; i < 4; ++i)
    isBehind = hn::And(isBehind, hn::Le(dot(set(region.corners[i]) - apex, towards), behind));

  const vec3 middle = 0.5f * (region.corners[0] + region.corners[2]);
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
