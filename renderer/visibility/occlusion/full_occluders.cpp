// Finds polygons that hide a whole patch from a light or from the eye.
#include <algorithm>

#include "renderer/visibility/occlusion/full_occluder.h"
#include "renderer/visibility/occlusion/occluders.h"

namespace lamplighter {
namespace {

// Polygons nearer to the eye than this may be clipped by the near plane, at 1 cm [m].
constexpr float kNotClipped = 0.05f;

}  // namespace

template <typename Tag>
LightMask Occluders::hiddenBy(const FullOccluder<Tag>& test, LightMask of, uint32_t object) const {
  LightMask open = of;
  objects_[object].polygonTree.visit(
      [&](const Bounds& b) { return (open & test.mayMeet(b)) != 0; },
      [&](uint32_t p) {
        const OccluderPolygon& polygon = objects_[object].polygons[p];
        if (const LightMask some = open & test.mayMeet(polygon.box); some != 0)
          open &= ~test.cut(polygon, some);
        return open != 0;
      });
  return of & ~open;
}

template <typename Tag>
LightMask Occluders::hiddenWithout(const FullOccluder<Tag>& test, LightMask of,
                                   std::span<const uint32_t> objects) const {
  LightMask open = of;
  polygonTree_.visit([&](const Bounds& b) { return (open & test.mayMeet(b)) != 0; },
                     [&](uint32_t object) {
                       if (std::find(objects.begin(), objects.end(), object) == objects.end())
                         open &= ~hiddenBy(test, open, object);
                       return open != 0;
                     });
  return of & ~open;
}

LightMask Occluders::hiddenWithout(const LightPacket& packet, const PatchRegion& region,
                                   LightMask of, std::span<const uint32_t> objects) const {
  const LightLanes<FloatTag> lights = lanesOf(packet, region);
  return hiddenWithout(FullOccluder<FloatTag>(lights, region), of, objects);
}

bool Occluders::hiddenWithout(const OcclusionPyramid& pyramid,
                              std::span<const uint32_t> objects) const {
  const LightLanes<OneLight> light = lanesOf(pyramid.light(), pyramid.region());
  return hiddenWithout(FullOccluder<OneLight>(light, pyramid.region()), light.all, objects) != 0;
}

bool Occluders::isHiddenBy(const OcclusionPyramid& pyramid, uint32_t object) const {
  const LightLanes<OneLight> light = lanesOf(pyramid.light(), pyramid.region());
  return hiddenBy(FullOccluder<OneLight>(light, pyramid.region()), light.all, object) != 0;
}

bool Occluders::hiddenFromEye(const RenderScene& s, const OcclusionPyramid& pyramid,
                              const vec3& eye) const {
  if (pyramid.isDark() || pyramid.isDegenerate()) return false;
  const LightLanes<OneLight> light = lanesOf(pyramid.light(), pyramid.region());
  const FullOccluder<OneLight> test(light, pyramid.region());
  const auto enter = [&](const Bounds& b) { return test.mayMeet(b) != 0; };
  return !polygonTree_.visit(enter, [&](uint32_t i) {
    return objects_[i].polygonTree.visit(enter, [&](uint32_t p) {
      const OccluderPolygon& polygon = objects_[i].polygons[p];
      const float before = glm::dot(polygon.normal, eye - polygon.corners[0]);
      const bool isDrawn = before > kNotClipped || (before < -kNotClipped && !s.backIsUnseen(i));
      return !(isDrawn && test.cut(polygon, light.all) != 0);
    });
  });
}

}  // namespace lamplighter
