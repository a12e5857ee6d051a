#include "renderer/bake/direct_light.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/sampling/light_gains.h"
#include "renderer/sampling/light_paths.h"
#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/light_linking.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// With fewer samples than this for each light, some would get none, and others their light.
constexpr size_t kSamplesPerLight = 4;
// A light with a larger factor is near: places on it are seen from too different distances to be
// samples of its visible share [sr]. An eighth of the largest factor.
constexpr float kNear = 0.4f;
constexpr uint32_t kNearRays = 256;
// Places along a side of a light whose mask is not used.
constexpr int kAnySide = 8;

// Along a ray to a triangle; infinite if it passes by (Möller and Trumbore 1997).
float distanceTo(const vec3& from, const vec3& towards, const vec3* triangle) {
  constexpr float kPasses = std::numeric_limits<float>::infinity();
  const vec3 ab = triangle[1] - triangle[0], ac = triangle[2] - triangle[0];
  const vec3 p = glm::cross(towards, ac);
  const float determinant = glm::dot(ab, p);
  if (determinant == 0.0f) return kPasses;
  const vec3 s = (from - triangle[0]) / determinant;
  const float u = glm::dot(s, p), v = glm::dot(towards, glm::cross(s, ab));
  const float t = glm::dot(ac, glm::cross(s, ab));
  return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && t > 0.0f ? t : kPasses;
}

}  // namespace

SampledLight sampledLight(const RayCaster& rays, std::span<const SceneVpl> samples,
                          const ReceivingPlace& at, std::optional<float> clampDistance) {
  const vec3 from = at.position + rayEpsilon(at.position) * at.normal;
  SampledLight sum;
  for (const SceneVpl& light : samples) {
    const shared::Vpl& vpl = light.vpl;
    const float clamp = clampDistance ? *clampDistance : std::sqrt(light.area / kPi);
    const float geometry = shared::vplGeometry(vpl, from, at.shadingNormal, at.normal, clamp);
    if (!(geometry > 0.0f) || isLeftOut(at.leftOutBy, static_cast<uint32_t>(vpl.footprint.y)))
      continue;
    sum.all += geometry * vpl.intensity;
    Ray ray{from, 0.0f, vec3(vpl.normal)};
    if (vpl.position.w != shared::kVplDirectional) {
      const vec3 way = vec3(vpl.position) - from;
      ray.tFar = glm::length(way);
      ray.direction = way / ray.tFar;
    }
    if (!rays.occluded(ray)) sum.visible += geometry * vpl.intensity;
  }
  return sum;
}

DirectLight::DirectLight(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                         const Options& options)
    : scene_(scene), rays_(rays), lights_(lights), options_(options) {
  const std::vector<VplId> ids = emitterIds(lights);
  VplCounts counts;
  counts.total = std::max(options.samples, static_cast<int>(kSamplesPerLight * ids.size()));
  counts.bounces = 0;
  counts.seed = options.seed;
  samples_ = LightPaths::generate(scene, rays, lights, counts).vpls;
  applyGains(lights, samples_);
  if (options.mask != 0) blockers_.update(scene, true, {});
  const auto idOf = [](const SceneVpl& s) { return VplId{s.id.light, s.id.emitter, 0, 0}; };
  std::ranges::stable_sort(samples_, {}, idOf);
  for (size_t e = 0; e < ids.size(); ++e) {
    EmitterFactor factor(scene, lights, e, ids[e], options.seed);
    const auto own = std::ranges::equal_range(samples_, ids[e], {}, idOf);
    emitters_.push_back({factor, factor.flat(options.mask != 0 ? options.mask : kAnySide),
                         static_cast<size_t>(own.begin() - samples_.begin()), own.size()});
  }
}

vec3 DirectLight::irradiance(const ReceivingPlace& at) const {
  const SurfaceSpot spot{at.position, at.shadingNormal, at.normal};
  std::vector<LightRay> rays;
  vec3 sum(0.0f);
  for (size_t e = 0; e < emitters_.size(); ++e) {
    const Emitter& emitter = lights_.emitters()[e];
    const Light& light = emitters_[e];
    if (emitter.gain == vec3(0.0f) || isLeftOut(at.leftOutBy, emitter.link)) continue;
    if (emitter.kind == EmitterKind::punctual) {
      light.factor.raysTo(std::span(&spot, 1), at.leftOutBy, 0, rays);
      for (const LightRay& r : rays)
        if (!rays_.occluded(r.ray)) sum += emitter.brightness() * r.irradiance;
      continue;
    }
    const float factor = light.factor.unshadowed(spot);
    if (factor > 0.0f) {
      sum += visibleShare(light, factor, spot, at) * emitter.reference * factor * emitter.gain;
    } else {
      sum += sampledLight(rays_, std::span(samples_).subspan(light.first, light.count), at,
                          std::nullopt)
                 .visible;
    }
  }
  return sum;
}

float DirectLight::visibleShare(const Light& light, float factor, const SurfaceSpot& spot,
                                const ReceivingPlace& at) const {
  if (light.flat) {
    const auto masked = options_.mask != 0 ? maskedShare(scene_, blockers_, *light.flat, spot)
                                           : std::optional<MaskedShare>();
    if (masked && (masked->isOpen || factor < kNear)) return masked->share;
    if (factor >= kNear) return nearShare(*light.flat, spot);
  }
  const SampledLight s =
      sampledLight(rays_, std::span(samples_).subspan(light.first, light.count), at, std::nullopt);
  const float all = s.all.r + s.all.g + s.all.b;
  return all > 0.0f ? (s.visible.r + s.visible.g + s.visible.b) / all : 0.0f;
}

// Share of rays towards the light, with density cos θ/π, that reach it.
float DirectLight::nearShare(const FlatLight& light, const SurfaceSpot& spot) const {
  const Frame frame(spot.normal);
  const vec3 from = spot.rayOrigin();
  const float margin = rayEpsilon(from);
  uint32_t all = 0, visible = 0;
  for (uint32_t i = 0; i < kNearRays; ++i) {
    const vec3 towards = frame.toWorld(sampleCosineHemisphere(sobol2(i, options_.seed)));
    if (glm::dot(towards, spot.geometricNormal) <= 0.0f) continue;
    float distance = std::numeric_limits<float>::infinity();
    for (size_t t = 0; t < light.triangles.size(); t += 3)
      distance = std::min(distance, distanceTo(from, towards, &light.triangles[t]));
    if (!std::isfinite(distance)) continue;
    ++all;
    visible += distance <= margin || !rays_.occluded({from, 0.0f, towards, distance - margin});
  }
  return all > 0 ? static_cast<float>(visible) / static_cast<float>(all) : 0.0f;
}

}  // namespace lamplighter
