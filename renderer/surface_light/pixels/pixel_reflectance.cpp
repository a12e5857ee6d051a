#include "renderer/surface_light/pixels/pixel_reflectance.h"

#include <algorithm>

#include "shaders/shared/brdf.h"

namespace lamplighter {

PixelReflectance reflectanceOf(const RenderScene& scene, const GBufferPoint& p, const vec2& weights,
                               const vec3& eye, const SurfacePictureOptions& options) {
  if (options.white) return {vec3(1.0f)};
  const Material& m = scene.materials[static_cast<size_t>(scene.objects[p.object].material)];
  if (!options.speculars || !mayBeGlossy(m)) return {p.albedo};
  const Gloss gloss = glossAt(scene, p.object, p.triangle, weights.x, weights.y);
  if (!shared::isGlossy(gloss.metallic, gloss.roughness)) return {p.albedo};
  const float nv = glm::dot(p.normal, glm::normalize(eye - p.position));
  const float diffuse =
      shared::diffuseShare(gloss.metallic, gloss.roughness, options.leastRoughness, nv);
  const float dielectric = (1.0f - gloss.metallic) * shared::dielectricShare(gloss.roughness) *
                           shared::dielectricAlbedo(gloss.roughness, options.leastRoughness, nv);
  return {diffuse * p.albedo, gloss.metallic * p.albedo + vec3(dielectric),
          std::max(gloss.roughness, options.leastRoughness)};
}

}  // namespace lamplighter
