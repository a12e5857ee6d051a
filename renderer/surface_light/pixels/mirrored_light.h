// Interface to the light that glossy surfaces mirror: light stored on surfaces, and the sky.
#pragma once

#include <cstdint>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

class MirroredLight {
 public:
  virtual ~MirroredLight() = default;
  // Identifies the hit of a ray. The value can be stored, so that edits of light trace no rays.
  // Thread-safe.
  virtual uint64_t placeOf(const Ray& ray, const Hit& hit) const = 0;
  // The current radiance of such a place [W/(m² sr)].
  virtual vec3 radianceOf(uint64_t place) const = 0;
  // Area for which one value of light is stored at this place [m²]; infinite if the value does not
  // represent the surface there: elements that represent many small triangles or are cut by a wall.
  virtual float areaOf(uint64_t place) const = 0;
  // Radiance of the sky for a ray that hits nothing [W/(m² sr)]; 0 if something else adds the sky.
  virtual vec3 skyTowards(const vec3& direction) const = 0;
};

}  // namespace lamplighter
