// Reflected light in glossy surfaces for methods that store light at surface elements.
#pragma once

#include "renderer/surface_light/gather_rays.h"
#include "renderer/surface_light/pixels/mirrored_light.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

class MeshMirror final : public MirroredLight {
 public:
  // Keeps references to its arguments.
  MeshMirror(const GatherScene& scene, const SurfaceLight& light) : scene_(scene), light_(&light) {}
  uint64_t placeOf(const Ray& ray, const Hit& hit) const override;
  vec3 radianceOf(uint64_t place) const override;
  float areaOf(uint64_t place) const override;
  vec3 skyTowards(const vec3& direction) const override;

 private:
  GatherScene scene_;
  const SurfaceLight* light_;
};

}  // namespace lamplighter
