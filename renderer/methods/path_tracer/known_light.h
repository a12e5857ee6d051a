// Interface to light that is known on surfaces, at which a path may end.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

class KnownLight {
 public:
  virtual ~KnownLight() = default;
  // The radiance that the surface at the hit reflects back along the ray, without its emission
  // [W/(m² sr)]. `spread`: the area over which similar paths spread there [m²]; returns none where
  // the light is stored too coarsely for it. Thread-safe.
  virtual std::optional<vec3> reflectedAt(const Ray& ray, const Hit& hit, float spread) const = 0;
};

}  // namespace lamplighter
