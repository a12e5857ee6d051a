// Shadow maps drawn from all triangles, for light samples at rest.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/shadow_maps/shadow_raster.h"
#include "renderer/imperfect_maps/map_light.h"

namespace lamplighter {

class RestMaps {
 public:
  // Call when the scene or the resolution of the maps changed.
  void outdate() { isCurrent_ = false; }
  // Simple objects are rasterised, others traced. The maps are concatenated, resolution² texels
  // each, as vpl_shading.h defines them; valid until the next call. The result does not depend on
  // the number of threads. Returns the number of rays.
  uint64_t draw(const RenderScene& scene, const RayCaster& rays, std::span<const MapLight> lights,
                int resolution);
  std::span<const float> maps() const { return maps_; }

 private:
  bool isCurrent_ = false;
  cpu::ShadowRaster raster_;
  cpu::ShadowMapGrid grid_;
  std::vector<float> maps_;
};

}  // namespace lamplighter
