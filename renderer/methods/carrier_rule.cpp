#include "renderer/methods/carrier_rule.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Maximum number of texels whose links can be summed in a frame of a drag: five bounces take 10 ms
// on two cores.
constexpr double kMostLinkedTexels = 10'000.0;

// Number of triangles above which a frame of a drag takes seconds with meshes: 2.4 s in a dungeon
// of 1.3 million triangles, with imperfect shadow maps 0.2 s.
constexpr size_t kMostMeshedTriangles = 600'000;

// Number of lamps above which levels of many triangles take long to settle with meshes, which
// compute the light of each lamp on each element: 19 s for 100 lamps in a hall, with imperfect
// shadow maps 7 s.
constexpr size_t kMostMeshedLamps = 32;

// Objects and punctual lights that shine while they are on.
size_t lampsOf(const RenderScene& scene) {
  const auto shines = [](const vec3& v) { return v != vec3(0.0f); };
  const auto objects = std::ranges::count_if(scene.objects, [&](const RenderObject& o) {
    return !o.isEmpty() && shines(scene.nominalEmission[static_cast<size_t>(o.material)]);
  });
  const auto punctuals = std::ranges::count_if(
      scene.punctuals, [&](const RenderPunctual& p) { return shines(p.nominal); });
  return static_cast<size_t>(objects + punctuals);
}

}  // namespace

CarrierChoice carrierFor(const RenderScene& scene, float texel) {
  const auto meshes = [](std::string reason) {
    return CarrierChoice{BouncedCarrier::meshes, std::move(reason)};
  };
  size_t triangles = 0;
  for (const RenderObject& o : scene.objects)
    if (!o.isAreaLight) triangles += o.triangleCount();
  if (const size_t lamps = lampsOf(scene);
      lamps > kMostMeshedLamps && static_cast<double>(triangles) > kMostLinkedTexels)
    return {BouncedCarrier::imperfect, fmt::format("{} lamps are many for meshes", lamps)};
  if (!scene.nominalSky.isBlack()) return meshes("the sky gives light");
  if (triangles > kMostMeshedTriangles)
    return {BouncedCarrier::imperfect, fmt::format("{} triangles are many for meshes", triangles)};
  // Tested before the area of a large scene is summed.
  if (static_cast<double>(triangles) > kMostLinkedTexels)
    return meshes(fmt::format("{} triangles are finer than texels", triangles));
  double area = 0.0;
  for (const RenderObject& o : scene.objects) {
    if (o.isAreaLight || o.isEmpty()) continue;
    if (mayBeGlossy(scene.materials[static_cast<size_t>(o.material)]))
      return meshes("some surfaces are glossy");
    area += areaOf(scene, o);
  }
  const double side = static_cast<double>(texel), texels = area / (side * side);
  if (texels > kMostLinkedTexels)
    return meshes(fmt::format("links would need {:.0f} texels", texels));
  if (static_cast<double>(triangles) > texels)
    return meshes(fmt::format("{} triangles are finer than {:.0f} texels", triangles, texels));
  return {BouncedCarrier::links,
          fmt::format("{} triangles are coarser than {:.0f} texels", triangles, texels)};
}

}  // namespace lamplighter
