#include "renderer/bake/baked_light.h"

#include <algorithm>
#include <utility>

#include "renderer/bake/inside.h"
#include "renderer/sampling/light_gains.h"
#include "renderer/sampling/light_paths.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

BakedLight::BakedLight(const RenderScene& scene, const RayCaster& rays,
                       const BakeLightOptions& options)
    : scene_(scene), rays_(rays), options_(options), lights_(LightSet::forPaths(scene)) {
  if (options.method == BakeMethod::settled) {
    // Suns are not divided into tiles, because rays need no shadow maps.
    vpls_ = LightPaths::generate(scene, rays, lights_, options.counts).vpls;
    applyGains(lights_, vpls_);
  }
  if (options.method == BakeMethod::meshes || options.method == BakeMethod::links)
    direct_.emplace(
        scene, rays, lights_,
        DirectLight::Options{options.counts.total, options.surface.mask, options.counts.seed});
  if (options.method == BakeMethod::meshes) {
    RenderSceneChanges changes;
    changes.rebuilt = true;
    // All rays in one call; another one where that finds samples inside of objects.
    while (!surface_.isDone())
      surface_.update(scene, std::exchange(changes, {}), rays, options.surface);
  }
  if (options.method == BakeMethod::links) gathered_.emplace(scene, rays, *direct_, options.texels);
}

vec3 BakedLight::irradiance(std::span<const BakePoint> points, uint32_t texel) const {
  Places places;
  for (const BakePoint& p : points) {
    const ReceivingPlace at = placeOf(p);
    if (!isInside(scene_, rays_, at, texel)) places.emplace_back(&p, at);
  }
  if (places.empty()) return vec3(-1.0f);
  vec3 sum(0.0f);
  if (options_.method != BakeMethod::reference) {
    for (const auto& [point, at] : places) sum += ofPlace(*point, at);
    if (options_.method == BakeMethod::links) sum += gathered(places);
    return sum / static_cast<float>(places.size());
  }
  // Paths are distributed over the points in turn.
  for (uint32_t i = 0; i < static_cast<uint32_t>(options_.samples); ++i) {
    sum += traceIrradiance(scene_, rays_, lights_, places[i % places.size()].second, texel, i,
                           options_.paths);
  }
  return sum / static_cast<float>(options_.samples);
}

ReceivingPlace BakedLight::placeOf(const BakePoint& point) const {
  const Surface s = surfaceAt(scene_, point.object, point.triangle, point.u, point.v);
  const uint32_t first = scene_.objects[point.object].firstIndex + 3 * point.triangle;
  const auto normal = [&](uint32_t k) { return scene_.normals[scene_.indices[first + k]]; };
  const vec3 smooth =
      (1.0f - point.u - point.v) * normal(0) + point.u * normal(1) + point.v * normal(2);
  const bool isSound = glm::dot(smooth, s.geometricNormal) > 0.0f;
  return {s.position, s.geometricNormal, isSound ? glm::normalize(smooth) : s.geometricNormal,
          scene_.objects[point.object].leftOutBy};
}

vec3 BakedLight::ofPlace(const BakePoint& point, const ReceivingPlace& at) const {
  if (options_.method == BakeMethod::settled)
    return sampledLight(rays_, vpls_, at, options_.clampDistance).visible;
  const vec3 direct = direct_->irradiance(at);
  return options_.method == BakeMethod::meshes ? direct + bounced(point, at.position) : direct;
}

vec3 BakedLight::bounced(const BakePoint& point, const vec3& position) const {
  MeshPoint on;
  if (!surface_.mesh().find(scene_, point.object, point.triangle, false, {point.u, point.v}, on))
    return vec3(0.0f);
  surface_.cuts().keepVisible(scene_, rays_, surface_.mesh(), position, on.leaf, on.weights);
  vec3 sum(0.0f);
  for (int k = 0; k < 3; ++k)
    sum += on.weights[k] * surface_.values()[on.values[static_cast<size_t>(k)]];
  return sum;
}

// The sum over the points. Bounced light is smooth within a texel: points on one triangle have that
// of their middle.
vec3 BakedLight::gathered(const Places& places) const {
  vec3 sum(0.0f);
  for (size_t first = 0; first < places.size(); ++first) {
    const auto isOnSame = [&](const Places::value_type& other) {
      return other.first->object == places[first].first->object &&
             other.first->triangle == places[first].first->triangle;
    };
    const auto begin = places.begin(), here = begin + static_cast<ptrdiff_t>(first);
    if (std::any_of(begin, here, isOnSame)) continue;
    BakePoint middle = *places[first].first;
    float count = 1.0f;
    for (auto other = here + 1; other != places.end(); ++other) {
      if (!isOnSame(*other)) continue;
      middle.u += other->first->u;
      middle.v += other->first->v;
      count += 1.0f;
    }
    middle.u /= count;
    middle.v /= count;
    sum += count * gathered_->irradiance(middle.object, middle.triangle, placeOf(middle));
  }
  return sum;
}

}  // namespace lamplighter
