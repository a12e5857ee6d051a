// Shadow maps of all triangles for light samples whose picture rests.
#pragma once

#include <span>
#include <vector>

#include "renderer/backends/cpu/shadow_maps/shadow_raster.h"
#include "renderer/imperfect_maps/map_light.h"

namespace lamplighter {

class RestMaps {
 public:
  // The scene changed, or the size of the maps [texels].
  void outdate() { isCurrent_ = false; }
  // Simple objects are rasterised, others traced. Maps are resolution² texels each, one after the
  // other, as vpl_shading.h defines them; valid until the next call. In parallel; the result does
  // not depend on it. Returns the number of rays.
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
