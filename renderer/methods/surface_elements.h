// Light on surfaces as a capability of Inspection.
#pragma once

#include "renderer/methods/inspection.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

class SurfaceElements final : public ElementView {
 public:
  SurfaceElements(const RenderScene& scene, const SurfaceLight& light)
      : scene_(scene), light_(light) {}

  std::optional<Place> placeAt(uint32_t object, uint32_t triangle, bool isBack,
                               const vec2& weights) const override;
  std::array<Corner, 3> cornersOf(uint32_t element) const override;

 private:
  const RenderScene& scene_;
  const SurfaceLight& light_;
};

}  // namespace lamplighter
