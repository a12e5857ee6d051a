// Light that a method stores on surfaces and at which paths of repair may end.
#pragma once

#include "renderer/methods/path_tracer/known_light.h"
#include "renderer/surface_light/pixels/mirrored_light.h"

namespace lamplighter {

class KnownSurfaces final : public KnownLight {
 public:
  // Keeps a reference to its argument.
  explicit KnownSurfaces(const MirroredLight& light) : light_(light) {}

  // Not near corners or mirrors, where the stored light is coarser than the spread of the paths.
  std::optional<vec3> reflectedAt(const Ray& ray, const Hit& hit, float spread) const override {
    const uint64_t place = light_.placeOf(ray, hit);
    if (spread < kLeastSpread * light_.areaOf(place)) return std::nullopt;
    return light_.radianceOf(place);
  }

 private:
  static constexpr float kLeastSpread = 4.0f;
  const MirroredLight& light_;
};

}  // namespace lamplighter
