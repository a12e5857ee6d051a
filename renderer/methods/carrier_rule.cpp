#include "renderer/methods/carrier_rule.h"

#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Texels of which all links fit in a frame of a drag: five bounces take 10 ms on two cores.
constexpr double kMostLinkedTexels = 10'000.0;

// Triangles with which a frame of a drag takes seconds with meshes: in a dungeon of 1.3 million
// 2.4 s, with imperfect shadow maps 0.2 s.
constexpr size_t kMostMeshedTriangles = 600'000;

}  // namespace

CarrierChoice carrierFor(const RenderScene& scene, float texel) {
  const auto meshes = [](std::string reason) {
    return CarrierChoice{BouncedCarrier::meshes, std::move(reason)};
  };
  if (!scene.nominalSky.isBlack()) return meshes("the sky gives light");
  size_t triangles = 0;
  for (const RenderObject& o : scene.objects)
    if (!o.isAreaLight) triangles += o.triangleCount();
  if (triangles > kMostMeshedTriangles)
    return {BouncedCarrier::imperfect, fmt::format("{} triangles are many for meshes", triangles)};
  // Before the area of a large scene is summed.
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
