// Reflected light in glossy surfaces for methods that store light at texels.
#pragma once

#include "renderer/surface_light/pixels/mirrored_light.h"
#include "renderer/texels/texel_irradiance.h"

namespace lamplighter {

class TexelMirror final : public MirroredLight {
 public:
  // Keeps references to its arguments.
  TexelMirror(const RenderScene& scene, const RayCaster& rays, const TexelIrradiance& light)
      : scene_(&scene), rays_(&rays), light_(&light) {}
  uint64_t placeOf(const Ray& ray, const Hit& hit) const override;
  vec3 radianceOf(uint64_t place) const override;
  float areaOf(uint64_t place) const override;
  vec3 skyTowards(const vec3& direction) const override { return light_->skyTowards(direction); }

 private:
  const RenderScene* scene_;
  const RayCaster* rays_;
  const TexelIrradiance* light_;
};

}  // namespace lamplighter
