#include "renderer/bake/baked_light.h"

#include <utility>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/light_gains.h"
#include "renderer/sampling/light_paths.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Number of rays for testing whether a point is inside an object: then most of them hit back faces.
constexpr uint32_t kInsideRays = 16;
constexpr uint32_t kInsideSet = 0x7d;

}  // namespace

BakedLight::BakedLight(const RenderScene& scene, const RayCaster& rays,
                       const BakeLightOptions& options)
    : scene_(scene), rays_(rays), options_(options), lights_(scene) {
  if (options.method == BakeMethod::settled) {
    // Suns are not divided into tiles, because rays need no shadow maps.
    vpls_ = LightPaths::generate(scene, rays, lights_, options.counts).vpls;
    applyGains(lights_, vpls_);
  }
  if (options.method == BakeMethod::meshes) {
    direct_.emplace(
        scene, rays, lights_,
        DirectLight::Options{options.counts.total, options.surface.mask, options.counts.seed});
    RenderSceneChanges changes;
    changes.rebuilt = true;
    // All rays in one call; another one where that finds samples inside of objects.
    while (!surface_.isDone())
      surface_.update(scene, std::exchange(changes, {}), rays, options.surface);
  }
}

vec3 BakedLight::irradiance(std::span<const BakePoint> points, uint32_t texel) const {
  std::vector<std::pair<const BakePoint*, ReceivingPlace>> places;
  for (const BakePoint& p : points) {
    const ReceivingPlace at = placeOf(p);
    if (!isBuried(at, texel)) places.emplace_back(&p, at);
  }
  if (places.empty()) return vec3(-1.0f);
  vec3 sum(0.0f);
  if (options_.method != BakeMethod::reference) {
    for (const auto& [point, at] : places) sum += ofPlace(*point, at);
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

bool BakedLight::isBuried(const ReceivingPlace& at, uint32_t texel) const {
  const Frame frame(at.normal);
  const vec3 from = at.position + rayEpsilon(at.position) * at.normal;
  uint32_t inside = 0;
  const uint32_t scramble = hash4(texel, 0, 0, kInsideSet);
  for (uint32_t i = 0; i < kInsideRays; ++i) {
    const vec3 direction = frame.toWorld(sampleCosineHemisphere(sobol2(i, scramble)));
    const Hit hit = rays_.intersect({from, 0.0f, direction});
    // Double-sided surfaces such as a curtain have no inside.
    if (!hit || !scene_.backIsUnseen(hit.object)) continue;
    const Surface s = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
    inside += glm::dot(s.geometricNormal, direction) > 0.0f;
  }
  return inside > kInsideRays / 2;
}

vec3 BakedLight::ofPlace(const BakePoint& point, const ReceivingPlace& at) const {
  if (options_.method == BakeMethod::settled)
    return sampledLight(rays_, vpls_, at, options_.clampDistance).visible;
  return direct_->irradiance(at) + bounced(point, at.position);
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

}  // namespace lamplighter
