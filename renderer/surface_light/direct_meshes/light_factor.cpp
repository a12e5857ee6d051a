#include "renderer/surface_light/direct_meshes/light_factor.h"

#include <cmath>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/scene/light_linking.h"

namespace lamplighter {
namespace {

// Maximum number of blockers for a mask; with more, rays are faster.
constexpr size_t kMostDrawn = 64;
// Points on a light: rays go to this number of them first, and to all if the results differ.
constexpr uint32_t kFirstRays = 64, kPoints = 256;
constexpr size_t kFewPoints = 16;  // for light without shadows
constexpr uint32_t kPointSet = 0x2f;

// The irradiance by a point that represents the whole light, without occlusion: the form factor of
// a disk, so that it stays finite near the light.
vec3 lightOf(const EmitterPoint& p, const vec3& position, const vec3& normal) {
  const vec3 d = p.position - position;
  const float d2 = glm::dot(d, d);
  if (!(d2 > 0.0f)) return vec3(0.0f);
  const vec3 w = d / std::sqrt(d2);
  const float there = p.bothSides ? std::abs(glm::dot(p.normal, w)) : -glm::dot(p.normal, w);
  const float here = glm::dot(normal, w);
  if (here <= 0.0f || there <= 0.0f) return vec3(0.0f);
  return here * there * p.area / (d2 + p.area / kPi) * p.share;
}

}  // namespace

LightFactor::LightFactor(const RenderScene& scene, const RayCaster& rays, const Blockers& blockers,
                         const LightSet& lights, size_t emitter, const VplId& id, uint32_t seed)
    : scene_(scene),
      rays_(rays),
      blockers_(blockers),
      link_(lights.emitters()[emitter].link),
      emitter_(emitter),
      factor_(scene, lights, emitter, id, seed),
      flat_(factor_.flat(FlatLight::kMostSide)) {
  const uint32_t scramble = hash4(static_cast<uint32_t>(id.light), id.emitter, seed, kPointSet);
  for (uint32_t i = 0; i < kPoints; ++i)
    points_.push_back(lights.samplePoint(scene, static_cast<int>(emitter), sobol2(i, scramble)));
}

bool LightFactor::isLeftOutBy(uint32_t leftOutBy) const { return isLeftOut(leftOutBy, link_); }

vec3 LightFactor::at(const SplitTree::Vertex& vertex, Work& work) const {
  if (isLeftOutBy(vertex.leftOutBy)) return vec3(0.0f);
  const SurfaceSpot spot{vertex.position, vertex.normal, vertex.normal};
  if (flat_) {
    const float all = flat_->emitsTowards(spot.position) ? factor_.unshadowed(spot) : 0.0f;
    if (all <= 0.0f) {
      ++work.open;
      return vec3(0.0f);
    }
    if (const auto seen = maskedShare(scene_, blockers_, *flat_, spot, kMostDrawn)) {
      ++(seen->isOpen ? work.open : work.masks);
      return vec3(all * seen->share);
    }
  }
  const Share share = shareOf(spot, work);
  return factor_.hasClosedForm() ? share.seen * factor_.unshadowed(spot) : share.seen * share.all;
}

// The same points of the light for all receivers, so that neighbours differ only by visibility.
LightFactor::Share LightFactor::shareOf(const SurfaceSpot& spot, Work& work) const {
  Share share;
  vec3 seen(0.0f), all(0.0f);
  const vec3 from = spot.rayOrigin();
  size_t traced = 0, hit = 0;
  const auto isPartial = [&] { return hit > 0 && hit < traced; };
  for (size_t i = 0; i < points_.size() && (i < kFirstRays || isPartial()); ++i) {
    const EmitterPoint& p = points_[i];
    const vec3 light = lightOf(p, spot.position, spot.normal);
    share.all += light;
    if (light == vec3(0.0f)) continue;
    const float side = glm::dot(p.normal, p.position - from) > 0.0f ? -1.0f : 1.0f;
    const vec3 way = p.position + side * rayEpsilon(p.position) * p.normal - from;
    all += light;
    ++traced;
    if (rays_.occluded({from, 0.0f, way, 1.0f}))
      ++hit;
    else
      seen += light;
  }
  work.rays += traced;
  share.all /= static_cast<float>(isPartial() ? points_.size() : kFirstRays);
  for (int c = 0; c < 3; ++c) share.seen[c] = all[c] > 0.0f ? seen[c] / all[c] : 0.0f;
  return share;
}

vec3 LightFactor::unshadowed(const vec3& position, const vec3& normal) const {
  if (factor_.hasClosedForm()) return vec3(factor_.unshadowed({position, normal, normal}));
  vec3 sum(0.0f);
  for (const EmitterPoint& p : points().first(kFewPoints)) sum += lightOf(p, position, normal);
  return sum / static_cast<float>(kFewPoints);
}

}  // namespace lamplighter
