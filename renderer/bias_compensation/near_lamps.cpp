#include "renderer/bias_compensation/near_lamps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/bias_compensation/seen_pixels.h"
#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/brdf.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// How far a lamp reaches, in distances between its samples, but at least in clamp distances; the
// correction fades in the last part.
constexpr float kReach = 8.0f, kFadeFrom = 0.75f;
// Shadow rays a lamp and pixel, and the smallest share of the light that is worth them.
constexpr int kRays = 4;
constexpr float kLeastShare = 1e-3f;

constexpr uint32_t kShadowSet = 0x8d;

// Hits of rays are rounded otherwise than points of triangles.
constexpr float kSlack = 1.01f;

float distanceBetween(const Bounds& a, const Bounds& b) {
  return glm::length(glm::max(glm::max(a.min - b.max, b.min - a.max), vec3(0.0f)));
}

float distanceTo(const Bounds& bounds, const vec3& p) {
  return glm::length(glm::max(glm::max(bounds.min - p, p - bounds.max), vec3(0.0f)));
}

}  // namespace

NearLamps::NearLamps(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                     const LightSampleTable& table, const LightControls& controls,
                     const BiasCompensation::Options& options)
    : scene_(scene), rays_(rays), options_(options) {
  if (!options.emission) return;
  const std::vector<Emitter>& emitters = lights.emitters();
  std::vector<Lamp> byEmitter(emitters.size());
  const std::vector<VplId> ids = emitterIds(lights);
  std::map<VplId, size_t> emitterOf;
  for (size_t i = 0; i < emitters.size(); ++i) {
    const Emitter& e = emitters[i];
    if (e.kind == EmitterKind::surface && e.cells.empty() && e.reference > 0.0f &&
        scene.objects[e.object].triangleCount() <= MeshFactor::kMostTriangles)
      emitterOf[ids[i]] = i;
  }
  // Which slots samples have depends on former edits.
  std::vector<const LightSample*> direct;
  for (const LightSample& sample : table.samples)
    if (sample.isLive && sample.id.bounce == 0) direct.push_back(&sample);
  std::ranges::sort(direct, {}, [](const LightSample* s) { return s->id; });
  for (const LightSample* sample : direct) {
    const auto it = emitterOf.find({sample->id.light, sample->id.emitter, 0, 0});
    if (it == emitterOf.end()) continue;
    shared::Vpl vpl = sample->vpl;
    vpl.intensity = table.reference[static_cast<size_t>(vpl.slot)];
    byEmitter[it->second].vpls.push_back(vpl);
  }
  isExact_.assign(scene.objects.size(), 0);
  for (size_t i = 0; i < emitters.size(); ++i) {
    Lamp& lamp = byEmitter[i];
    if (lamp.vpls.empty()) continue;
    const Emitter& e = emitters[i];
    const RenderObject& object = scene.objects[e.object];
    lamp.id = ids[i];
    lamp.seed = hash4(static_cast<uint32_t>(ids[i].light), ids[i].emitter, 0, kShadowSet);
    lamp.control = controls.ofEmitter.at(ids[i]);
    lamp.link = e.link;
    lamp.bounds = object.bounds;
    lamp.radiance = e.reference;
    const float spacing = std::sqrt(e.area / static_cast<float>(lamp.vpls.size()));
    lamp.reach = std::max(kReach * spacing, options.clampDistance / kFadeFrom);
    std::vector<vec3> corners;
    for (uint32_t k = 0; k < object.indexCount; ++k)
      corners.push_back(scene.positions[scene.indices[object.firstIndex + k]]);
    lamp.factor = MeshFactor(corners, e.bothSides);
    isExact_[e.object] = 1;
    lamps_.push_back(std::move(lamp));
  }
  std::ranges::sort(lamps_, {}, &Lamp::id);
}

void NearLamps::findRows(const View& view, vec2 jitter, uint32_t sample, int first, int last,
                         std::span<std::vector<BiasCompensation::Contribution>> byRow) const {
  tbb::parallel_for(first, last, [&](int y) {
    std::vector<float> upTo;
    std::vector<const Lamp*> near;  // of a group of pixels
    for (int x0 = 0; x0 < view.width; x0 += SeenPixels::kCount) {
      const auto [rays, hits] = SeenPixels(rays_, view, jitter, x0, y);
      Bounds seen;
      for (int i = 0; i < SeenPixels::kCount; ++i)
        if (hits[i]) seen.add(rays[i].origin + hits[i].t * rays[i].direction);
      near.clear();
      for (const Lamp& lamp : lamps_)
        if (!seen.empty() && distanceBetween(lamp.bounds, seen) < kSlack * lamp.reach)
          near.push_back(&lamp);
      if (near.empty()) continue;
      for (int i = 0; i < std::min(SeenPixels::kCount, view.width - x0); ++i) {
        const Hit& hit = hits[i];
        if (!hit) continue;
        const Surface s = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
        const vec3& way = rays[i].direction;
        const float side = glm::dot(way, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
        const Point point{s.position, side * s.normal, side * s.geometricNormal,
                          scene_.objects[hit.object].leftOutBy};
        const auto pixel = static_cast<uint32_t>(y * view.width + x0 + i);
        vec3 albedo(-1.0f);
        for (const Lamp* candidate : near) {
          const Lamp& lamp = *candidate;
          if (distanceTo(lamp.bounds, s.position) >= lamp.reach) continue;
          const float u = toUnitFloat(hash4(pixel, sample, lamp.seed, options_.seed));
          const float missing = missingAt(lamp, point, u, upTo);
          if (missing == 0.0f) continue;
          if (albedo.x < 0.0f) {
            albedo = options_.white ? vec3(1.0f) : s.albedo;
            if (options_.speculars && !options_.white) {
              const Gloss gloss = glossAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
              albedo *= shared::diffuseShare(gloss.metallic, gloss.roughness,
                                             options_.leastRoughness, -glm::dot(point.normal, way));
            }
          }
          byRow[static_cast<size_t>(y)].push_back(
              {pixel, lamp.control, missing * (1.0f / kPi) * albedo});
        }
      }
    }
  });
}

float NearLamps::missingAt(const Lamp& lamp, const Point& point, float u,
                           std::vector<float>& upTo) const {
  if (isLeftOut(point.leftOutBy, lamp.link)) return 0.0f;
  upTo.clear();
  float sum = 0.0f;
  for (const shared::Vpl& vpl : lamp.vpls) {
    sum += vpl.intensity.x * shared::vplGeometry(vpl, point.position, point.normal,
                                                 point.geometricNormal, options_.clampDistance);
    upTo.push_back(sum);
  }
  if (!(sum > 0.0f)) return 0.0f;
  const float all = lamp.radiance * lamp.factor.at(point.position, point.normal),
              missing = all - sum;
  if (std::abs(missing) < kLeastShare * all) return 0.0f;
  const float distance = distanceTo(lamp.bounds, point.position) / lamp.reach;
  const float fade = std::min(1.0f, (1.0f - distance) / (1.0f - kFadeFrom));
  // Shadow rays to samples, chosen in proportion to their light.
  const vec3 from = point.position + rayEpsilon(point.position) * point.geometricNormal;
  int seen = 0;
  for (int k = 0; k < kRays; ++k) {
    const float below = (static_cast<float>(k) + u) / kRays * sum;
    const auto at = std::upper_bound(upTo.begin(), upTo.end() - 1, below) - upTo.begin();
    const vec3 way = vec3(lamp.vpls[static_cast<size_t>(at)].position) - from;
    const float length = glm::length(way);
    if (length > 0.0f && !rays_.occluded({from, 0.0f, way / length, length})) ++seen;
  }
  return fade * missing * static_cast<float>(seen) / kRays;
}

}  // namespace lamplighter
