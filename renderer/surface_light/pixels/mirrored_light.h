// What glossy surfaces mirror: light that is kept on surfaces, and the sky, as rays find it.
#pragma once

#include <cstdint>

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

class MirroredLight {
 public:
  virtual ~MirroredLight() = default;
  // What the ray sees where it hits, in a form to be kept: other light needs no other ray. Several
  // threads may call it.
  virtual uint64_t placeOf(const Ray& ray, const Hit& hit) const = 0;
  // What such a place sends now [W/(m² sr)].
  virtual vec3 radianceOf(uint64_t place) const = 0;
  // Over how large an area light is kept as one value [m²]; infinite where it is not that of the
  // surface at the place: of elements that stand for many small triangles, or are cut by a wall.
  virtual float areaOf(uint64_t place) const = 0;
  // What a ray that hits nothing sees [W/(m² sr)]; 0 if the sky is shown by something else.
  virtual vec3 skyTowards(const vec3& direction) const = 0;
};

}  // namespace lamplighter
