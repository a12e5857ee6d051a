// The sky as a light: directions by how much comes from them, whatever kind of sky it is.
#pragma once

#include "renderer/scene/sky.h"
#include "renderer/scene/sky_map.h"

namespace lamplighter {

class SkySampler {
 public:
  SkySampler() = default;
  explicit SkySampler(const Sky& sky) : sky_(sky) {}

  const Sky& sky() const { return sky_; }
  vec3 radiance(const vec3& towards) const { return sky_.radianceFrom(towards); }

  // For VPLs and paths. ∫ L dω, the suns left out [W/m²].
  vec3 irradiance() const;
  // A direction of all but the suns, with density by luminance: for all u the samples have the same
  // luminance, that of irradiance().
  SkyMap::Light sample(vec2 u) const;
  // The suns of a picture, SkyMap::suns(); its mean direction, or a place on it.
  size_t sunCount() const;
  SkyMap::Light sun(size_t i) const;
  SkyMap::Light sun(size_t i, vec2 u) const;

  // For unbiased estimates: a direction and its density by solid angle [1/sr]. A constant sky needs
  // no such sampling: directions by the cosine are as good as any.
  bool isConstant() const { return sky_.kind == SkyKind::constant; }
  SkyMap::Direction sampleDensity(vec2 u) const;
  float density(const vec3& towards) const;

 private:
  vec3 turned(const vec3& d) const;    // from the picture's frame to the world's
  vec3 unturned(const vec3& d) const;  // and back

  Sky sky_;
};

}  // namespace lamplighter
