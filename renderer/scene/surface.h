// What is at a point of a triangle: normals, albedo, emission; textures and normal map included.
#pragma once

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct Surface {
  vec3 position{0.0f};
  vec3 geometricNormal{0.0f, 0.0f, 1.0f};  // unit, the triangle's counter-clockwise (front) side
  vec3 normal{0.0f, 0.0f, 1.0f};           // unit, interpolated and normal-mapped, front side
  vec3 albedo{0.0f};                       // Lambertian ρ
  vec3 emission{0.0f};                     // radiance that leaves the front face [W/(m² sr)]
  bool emitsBothSides = false;
};

// u, v: barycentric weights of the triangle's second and third vertex, as Embree gives them.
Surface surfaceAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// What the eye sees of a material beside its albedo (shaders/shared/brdf.h).
struct Gloss {
  float metallic = 0.0f, roughness = 1.0f;
};
// Whether any point of the material may have a lobe.
bool mayBeGlossy(const Material& material);
// At the point, texture included. Only for surfaces that the eye sees: what bounces is Lambert.
Gloss glossAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// Of the material's emission what leaves the front face there: by its texture, and nothing where
// the alpha mask has a hole.
vec3 emissionShareAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u,
                     float v);

// Alpha of the base colour there, vertex colour included: what alpha masks are tested with.
float alphaAt(const RenderScene& scene, uint32_t object, uint32_t triangle, float u, float v);

// A bilinear look-up, sRGB decoded where `srgb`; u to the right, v down, wrapped as the texture
// says.
vec4 sampleTexture(const Texture& texture, vec2 uv, bool srgb);

}  // namespace lamplighter
