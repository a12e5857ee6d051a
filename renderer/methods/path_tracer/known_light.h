// Light that is known on surfaces, by which a path may end.
#pragma once

#include <optional>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

class KnownLight {
 public:
  virtual ~KnownLight() = default;
  // What the surface at the hit reflects back along the ray, without its own emission
  // [W/(m² sr)]. `spread`: the area over which paths like this one spread there [m²]; none where
  // light is not known as finely. Several threads may call it.
  virtual std::optional<vec3> reflectedAt(const Ray& ray, const Hit& hit, float spread) const = 0;
};

}  // namespace lamplighter
