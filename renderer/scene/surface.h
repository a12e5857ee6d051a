// Surface properties at a point of a triangle: normals, albedo and emission, including textures and
// normal map.
#pragma once

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct Surface {
  vec3 position{0.0f};
  vec3 geometricNormal{0.0f, 0.0f, 1.0f};  // unit, on the triangle's front (counter-clockwise) side
  vec3 normal{0.0f, 0.0f, 1.0f};           // unit, interpolated and normal-mapped, front side
  vec3 albedo{0.0f};                       // Lambertian ρ
  vec3 emission{0.0f};                     // radiance emitted from the front face [W/(m² sr)]
  bool emitsBothSides = false;
};

// u, v: barycentric weights of the triangle's second and third vertex, as Embree gives them.
Surface surfaceAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// Properties for specular reflection, besides the albedo (shaders/shared/brdf.h).
struct Gloss {
  float metallic = 0.0f, roughness = 1.0f;
};
// Whether any point of the material may have a specular lobe.
bool mayBeGlossy(const Material& material);
// Values at the point, including the texture. Only for directly visible surfaces, because bounced
// light is reflected diffusely, except for glossy_bounces of the reference.
Gloss glossAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// Area of all triangles [m²].
double areaOf(const RenderScene& scene, const RenderObject& object);

// Factor of the material's emission at the point of the front face: by the emissive texture; 0 in a
// hole of the alpha mask.
vec3 emissionShareAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u,
                     float v);

// Alpha of the base colour at the point, including the vertex colour; alpha masks are tested with
// it.
float alphaAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// Bilinear look-up, sRGB-decoded if `srgb`; u points right, v down; uses the wrap modes of the
// texture.
vec4 sampleTexture(const Texture& texture, vec2 uv, bool srgb);

}  // namespace lamplighter
