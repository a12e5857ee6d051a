#include "renderer/backends/cpu/irradiance/specular_shading.h"

#include <algorithm>

#include "shaders/shared/brdf.h"

namespace lamplighter::cpu {
namespace {

// Reads the texture at the pixel's position in its triangle.
Gloss glossOf(const RenderScene& scene, const GBuffer& g, size_t i) {
  const RenderObject& object = scene.objects[g.object[i]];
  const Material& m = scene.materials[static_cast<size_t>(object.material)];
  if (m.metallicRoughnessTexture.texture == kNone) return {m.metallic, m.roughness};
  const uint32_t* corner = &scene.indices[object.firstIndex + 3 * g.triangle[i]];
  const vec3 a = scene.positions[corner[0]], b = scene.positions[corner[1]] - a,
             c = scene.positions[corner[2]] - a, p = vec3(g.px[i], g.py[i], g.pz[i]) - a;
  const vec3 area = glm::cross(b, c);
  const float inverse = 1.0f / std::max(glm::dot(area, area), 1e-30f);
  const float u = std::clamp(glm::dot(glm::cross(p, c), area) * inverse, 0.0f, 1.0f);
  const float v = std::clamp(glm::dot(glm::cross(b, p), area) * inverse, 0.0f, 1.0f - u);
  return glossAt(scene, g.object[i], g.triangle[i], u, v);
}

}  // namespace

std::vector<uint8_t> findGlossy(const RenderScene& scene) {
  std::vector<uint8_t> mayBe;
  mayBe.reserve(scene.objects.size());
  for (const RenderObject& object : scene.objects)
    mayBe.push_back(mayBeGlossy(scene.materials[static_cast<size_t>(object.material)]));
  return mayBe;
}

std::vector<Gloss> findGloss(const RenderScene& scene, const GBuffer& g, size_t tile,
                             std::span<const uint8_t> mayBeGlossy) {
  std::vector<Gloss> found;
  const uint64_t only = g.onlyTriangle[tile];
  if (only != GBuffer::kMany && mayBeGlossy[only >> 32] == 0) return found;
  for (size_t in = 0; in < kTilePixels; ++in) {
    const size_t i = tile * kTilePixels + in;
    if (g.hit[i] == 0 || mayBeGlossy[g.object[i]] == 0) continue;
    const Gloss gloss = glossOf(scene, g, i);
    if (!shared::isGlossy(gloss.metallic, gloss.roughness)) continue;
    if (found.empty()) found.resize(kTilePixels);
    found[in] = gloss;
  }
  return found;
}

void addSpecular(const GBuffer& g, size_t i, const vec3& eye, const Gloss& gloss,
                 float leastRoughness, const vec3& specular, bool hasEmission, vec3& radiance) {
  const vec3 toEye = glm::normalize(eye - vec3(g.px[i], g.py[i], g.pz[i]));
  const float nv = glm::dot(toEye, vec3(g.sx[i], g.sy[i], g.sz[i]));
  const float share = shared::diffuseShare(gloss.metallic, gloss.roughness, leastRoughness, nv);
  const vec3 emission = hasEmission ? g.emission(i) : vec3(0.0f);
  radiance = emission + share * (radiance - emission) + specular;
}

}  // namespace lamplighter::cpu
