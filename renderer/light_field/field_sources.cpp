#include "renderer/light_field/field_sources.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Number of points in the part of the sphere of a direction at which the sky is sampled.
constexpr uint32_t kSkyPlaces = 32;
constexpr uint32_t kSkyPlaceSet = 0x51ce;

vec4 sentBy(const vec3& radiance) { return {radiance, 0.0f}; }

// Radiance of the sky without suns; 0 without a sky.
vec3 skyBrightness(const LightSet& lights) {
  if (lights.unitSky().isBlack()) return vec3(0.0f);
  for (const Emitter& e : lights.emitters())
    if (e.kind == EmitterKind::sky && e.skySun == 0) return e.brightness();
  return vec3(0.0f);
}

// Radiance of the places of an area light: the mean over some points of each.
std::vector<vec4> emissionOfLamp(const RenderScene& scene, uint32_t object) {
  constexpr uint32_t kPoints = 1024, kLeastPoints = 16, kPointSet = 0x1a3b;
  const RenderObject& o = scene.objects[object];
  std::vector<vec4> sums(FieldSurface::kLampPlaces, vec4(0.0f));
  const Material& material = scene.materials[static_cast<size_t>(o.material)];
  if (material.emissiveTexture.texture == kNone) {
    const vec4 even = sentBy(surfaceAt(scene, object, 0, 0.0f, 0.0f).emission);
    return std::vector<vec4>(FieldSurface::kLampPlaces, even);
  }
  const uint32_t points = std::max(kLeastPoints, kPoints / std::max(o.triangleCount(), 1u));
  for (uint32_t t = 0; t < o.triangleCount(); ++t) {
    const uint32_t* i = &scene.indices[o.firstIndex + 3 * t];
    for (uint32_t k = 0; k < points; ++k) {
      vec2 w = sobol2(k, kPointSet + t);  // weights of the second and third corner
      if (w.x + w.y > 1.0f) w = 1.0f - w;
      const vec2 uv =
          (1.0f - w.x - w.y) * scene.uv0[i[0]] + w.x * scene.uv0[i[1]] + w.y * scene.uv0[i[2]];
      const glm::ivec2 at = glm::clamp(glm::ivec2(static_cast<float>(FieldSurface::kLampSide) * uv),
                                       0, FieldSurface::kLampSide - 1);
      sums[static_cast<size_t>(at.y * FieldSurface::kLampSide + at.x)] +=
          vec4(surfaceAt(scene, object, t, w.x, w.y).emission, 1.0f);
    }
  }
  for (vec4& sum : sums) sum = sum.w > 0.0f ? sentBy(vec3(sum) / sum.w) : vec4(0.0f);
  return sums;
}

// Mean over the area of a texel of an emissive surface.
vec3 emissionOf(const RenderScene& scene, const SurfaceTexel& texel) {
  const uint32_t triangles = scene.objects[texel.object].triangleCount();
  vec3 sum(0.0f);
  for (const SurfacePlace& place : texel.spread) {
    const bool isBack = place.triangle >= triangles;
    const Surface s =
        surfaceAt(scene, texel.object, place.triangle - (isBack ? triangles : 0), place.u, place.v);
    if (!isBack || s.emitsBothSides) sum += s.emission;
  }
  return sum / static_cast<float>(texel.spread.size());
}

}  // namespace

vec3 skyRadiance(const LightSet& lights, const vec3& towards) {
  const vec3 brightness = skyBrightness(lights);
  if (brightness == vec3(0.0f)) return brightness;
  return brightness * lights.referenceSky().withoutSuns(towards) / lights.skyReference();
}

std::vector<vec4> skyOf(const LightSet& lights, const FieldDirections& directions) {
  std::vector<vec4> out(2 * directions.size(), vec4(0.0f));
  const vec3 brightness = skyBrightness(lights);
  if (brightness == vec3(0.0f)) return out;
  tbb::parallel_for(size_t{0}, out.size(), [&](size_t end) {
    const size_t d = end % directions.size();
    const float radius = std::sqrt(directions.weightOf(d) / kPi);
    const Frame frame(end == d ? directions[d] : -directions[d]);
    vec3 sum(0.0f);
    for (uint32_t k = 0; k < kSkyPlaces; ++k) {
      const vec2 u = sobol2(k, kSkyPlaceSet);
      const float far = radius * std::sqrt(u.x), turn = 2.0f * kPi * u.y;
      const vec3 at =
          glm::normalize(frame.toWorld({far * std::cos(turn), far * std::sin(turn), 1.0f}));
      sum += lights.referenceSky().withoutSuns(at) / lights.skyReference();
    }
    out[end] = sentBy(brightness * sum / static_cast<float>(kSkyPlaces));
  });
  return out;
}

std::vector<vec4> fieldSources(const RenderScene& scene, const LightSet& lights,
                               const TexelSet& texels, const FieldSurface& surface, bool withLamps,
                               const FieldDirections& directions) {
  std::vector<vec4> out(texels.size(), vec4(0.0f));
  const std::vector<vec4> sky = skyOf(lights, directions);
  out.insert(out.end(), sky.begin(), sky.end());
  out.emplace_back(0.0f);  // PartnerNumbers::dark()
  if (!withLamps) return out;
  for (const uint32_t object : surface.lamps()) {
    const std::vector<vec4> lamp = emissionOfLamp(scene, object);
    out.insert(out.end(), lamp.begin(), lamp.end());
  }
  for (const Emitter& e : lights.emitters()) {
    if (e.kind != EmitterKind::surface || scene.objects[e.object].isAreaLight) continue;
    for (const size_t side : {2 * e.object, 2 * e.object + 1}) {
      const TexelSet::Part& part = texels.parts()[side];
      for (uint32_t t = part.first; t < part.first + part.count; ++t)
        out[t] = sentBy(emissionOf(scene, texels[t]));
    }
  }
  return out;
}

}  // namespace lamplighter
