#include "renderer/surface_light/emitter_factor.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_linking.h"
#include "renderer/surface_light/form_factor.h"

namespace lamplighter {
namespace {

constexpr uint32_t kLightPointSet = 0x1f;
// Maximum number of triangles for the closed form.
constexpr uint32_t kMostTriangles = 12;

// The cosine for light from the unit direction w; 0 below the surface.
float cosineOf(const SurfaceSpot& spot, const vec3& w) {
  return glm::dot(spot.geometricNormal, w) > 0.0f ? std::max(0.0f, glm::dot(spot.normal, w)) : 0.0f;
}

}  // namespace

RenderPunctual withoutBrightness(RenderPunctual light) {
  light.light.intensity = light.nominal = vec3(0.0f);
  return light;
}

EmitterFactor::EmitterFactor(const RenderScene& scene, const LightSet& lights, size_t emitter,
                             const VplId& id, uint32_t seed)
    : scene_(scene),
      lights_(lights),
      light_(lights.emitters()[emitter]),
      emitter_(static_cast<int>(emitter)),
      seed_(hash4(static_cast<uint32_t>(id.light), id.emitter, seed, kLightPointSet)) {
  if (light_.kind == EmitterKind::surface) {
    const RenderObject& o = scene.objects[light_.object];
    bounds_ = o.bounds;
    if (isColoured() || o.triangleCount() > kMostTriangles) return;
    for (uint32_t i = 0; i < o.indexCount; ++i)
      corners_.push_back(scene.positions[scene.indices[o.firstIndex + i]]);
  }
  if (light_.kind == EmitterKind::punctual &&
      scene.punctuals[light_.punctual].light.kind != PunctualKind::directional)
    bounds_.add(scene.punctuals[light_.punctual].position);
}

bool EmitterFactor::isColoured() const {
  return (light_.kind == EmitterKind::surface && !light_.cells.empty()) ||
         light_.kind == EmitterKind::sky;
}

void EmitterFactor::raysTo(std::span<const SurfaceSpot> spots, uint32_t leftOutBy, uint32_t key,
                           std::vector<LightRay>& out) const {
  out.clear();
  if (!isSampled() || isLeftOut(leftOutBy, light_.link)) return;
  const uint32_t scramble = hash4(key, 0, seed_, kLightPointSet);
  for (uint32_t i = 0; i < spots.size(); ++i) {
    const SurfaceSpot& spot = spots[i];
    LightRay ray;
    if (light_.kind == EmitterKind::surface) ray = fromSurface(spot, sobol2(i, scramble));
    if (light_.kind == EmitterKind::punctual) ray = fromPunctual(spot);
    if (light_.kind == EmitterKind::sky) ray = fromSun(spot, sobol2(i, scramble));
    ray.spot = i;
    if (ray.irradiance != vec3(0.0f)) out.push_back(ray);
  }
}

float EmitterFactor::unshadowed(const SurfaceSpot& spot) const {
  float factor = 0.0f;
  for (size_t i = 0; i < corners_.size(); i += 3) {
    const vec3 cross = glm::cross(corners_[i + 1] - corners_[i], corners_[i + 2] - corners_[i]);
    if (!light_.bothSides && glm::dot(cross, spot.position - corners_[i]) <= 0.0f) continue;
    factor += polygonFactor(spot.position, spot.normal, std::span(corners_).subspan(i, 3));
  }
  return factor;
}

std::optional<FlatLight> EmitterFactor::flat(int side) const {
  if (side == 0 || corners_.empty()) return std::nullopt;
  return flatLightOf(scene_, light_.object, side);
}

LightRay EmitterFactor::fromSurface(const SurfaceSpot& spot, const vec2& u) const {
  const EmitterPoint p = lights_.samplePoint(scene_, emitter_, u);
  const vec3 d = p.position - spot.position;
  const float d2 = glm::dot(d, d);
  if (!(d2 > 0.0f)) return {};
  const vec3 w = d / std::sqrt(d2);
  const float there = p.bothSides ? std::abs(glm::dot(p.normal, w)) : -glm::dot(p.normal, w);
  const float here = cosineOf(spot, w);
  float factor = 0.0f;
  if (corners_.empty()) {
    // The form factor of a disk, so that it stays finite near the light.
    if (here > 0.0f && there > 0.0f) factor = here * there * p.area / (d2 + p.area / kPi);
  } else {
    factor = unshadowed(spot);
  }
  const vec3 from = spot.rayOrigin();
  const float side = glm::dot(p.normal, w) > 0.0f ? -1.0f : 1.0f;
  const vec3 way = p.position + side * rayEpsilon(p.position) * p.normal - from;
  const float distance = glm::length(way);
  if (!(distance > 0.0f)) return {};
  return {{from, 0.0f, way / distance, distance}, factor * p.share};
}

LightRay EmitterFactor::fromPunctual(const SurfaceSpot& spot) const {
  const RenderPunctual& light = scene_.punctuals[light_.punctual];
  const vec3 from = spot.rayOrigin();
  if (light.light.kind == PunctualKind::directional)
    return {{from, 0.0f, -light.direction}, vec3(cosineOf(spot, -light.direction))};
  const vec3 d = light.position - spot.position;
  const float d2 = glm::dot(d, d);
  if (!(d2 > 0.0f)) return {};
  const float distance = std::sqrt(d2);
  const vec3 w = d / distance;
  float factor = cosineOf(spot, w) / d2;
  if (factor > 0.0f && light.light.profile)
    factor *= light.light.profile->at(glm::transpose(light.axes) * -w);
  else if (light.light.kind == PunctualKind::spot)
    factor *= SpotCone(light.light).at(-glm::dot(w, light.direction));
  return {{from, 0.0f, w, distance}, vec3(factor)};
}

LightRay EmitterFactor::fromSun(const SurfaceSpot& spot, const vec2& u) const {
  const SkyMap::Light sun = lights_.referenceSky().sun(light_.skySun - 1, u);
  return {{spot.rayOrigin(), 0.0f, sun.towards},
          cosineOf(spot, sun.towards) * sun.irradiance / light_.reference};
}

}  // namespace lamplighter
