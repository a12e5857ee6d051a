#include "renderer/methods/surface_elements.h"

namespace lamplighter {

std::optional<ElementView::Place> SurfaceElements::placeAt(uint32_t object, uint32_t triangle,
                                                           bool isBack, const vec2& weights) const {
  MeshPoint point;
  if (!light_.mesh().find(scene_, object, triangle, isBack, weights, point)) return std::nullopt;
  return Place{point.leaf, point.weights, light_.mesh().isCluster(point.leaf),
               light_.trustAt(point)};
}

std::array<ElementView::Corner, 3> SurfaceElements::cornersOf(uint32_t element) const {
  std::array<Corner, 3> corners;
  const auto samples = light_.mesh().samplesOfLeaf(element);
  for (size_t c = 0; c < 3; ++c)
    corners[c] = {light_.values()[samples[c]], light_.links().pendingShareOf(samples[c]),
                  light_.isBuried(samples[c])};
  return corners;
}

}  // namespace lamplighter
