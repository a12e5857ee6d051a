// Samples the sky as a light: directions by radiance, for all kinds of sky.
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
  // 0 in the suns, which are separate lights.
  vec3 withoutSuns(const vec3& towards) const;

  // For VPLs and paths: ∫ L dω without the suns [W/m²].
  vec3 irradiance() const;
  // A direction of the sky without suns, with density by luminance. All samples have the same
  // luminance, that of irradiance().
  SkyMap::Light sample(vec2 u) const;
  // The suns of a sky image, see SkyMap::suns(): the mean direction, or a sampled direction within
  // the sun.
  size_t sunCount() const;
  SkyMap::Light sun(size_t i) const;
  SkyMap::Light sun(size_t i, vec2 u) const;

  // For unbiased estimates: a direction and its density [1/sr]. Not needed for a constant sky,
  // where cosine-weighted directions are as good.
  bool isConstant() const { return sky_.kind == SkyKind::constant; }
  SkyMap::Direction sampleDensity(vec2 u) const;
  float density(const vec3& towards) const;

 private:
  vec3 turned(const vec3& d) const;    // from the frame of the sky image to world space
  vec3 unturned(const vec3& d) const;  // and back

  Sky sky_;
};

}  // namespace lamplighter
