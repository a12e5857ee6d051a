#include "renderer/imperfect_maps/rest_maps.h"

#include <atomic>

#include <tbb/parallel_for.h>

namespace lamplighter {

uint64_t RestMaps::draw(const RenderScene& scene, const RayCaster& rays,
                        std::span<const MapLight> lights, int resolution) {
  if (!isCurrent_) raster_.setScene(scene);
  isCurrent_ = true;
  if (grid_.resolution != resolution) grid_ = cpu::ShadowMapGrid(resolution);
  const size_t texels = static_cast<size_t>(resolution) * static_cast<size_t>(resolution);
  maps_.resize(lights.size() * texels);
  const auto bands =
      static_cast<size_t>((resolution + cpu::ShadowRaster::kBand - 1) / cpu::ShadowRaster::kBand);
  std::atomic<uint64_t> cast{0};
  tbb::parallel_for(size_t{0}, lights.size(), [&](size_t i) {
    std::vector<uint8_t> isTraced(bands, 0);
    cast += raster_.render(rays, grid_, lights[i].vpl, 0, resolution,
                           std::span(maps_).subspan(i * texels, texels), {}, isTraced);
  });
  return cast;
}

}  // namespace lamplighter
