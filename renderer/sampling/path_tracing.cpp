#include "renderer/sampling/path_tracing.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "renderer/base/random.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Dimension pairs: 0 and 1 are the start position and direction of a path; those of bounce b > 0
// follow. This one, after those of all bounces, selects the part of the level that parallel light
// passes through.
constexpr uint32_t kChoiceDimension = 100;

bool isBlack(const vec3& c) { return !(c.r > 0.0f || c.g > 0.0f || c.b > 0.0f); }

// Uniform over a cap around Z.
vec3 sampleCap(float cap, vec2 u) {
  const float z = 1.0f - u.x * cap;
  const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
  const float phi = 2.0f * kPi * u.y;
  return {r * std::cos(phi), r * std::sin(phi), z};
}

}  // namespace

bool PathStep::ends() const { return !hit || isBlack(albedo); }

SpotCone::SpotCone(const PunctualLight& light)
    : scale(1.0f / std::max(0.001f, std::cos(light.innerCone) - std::cos(light.outerCone))),
      offset(-std::cos(light.outerCone) * scale) {}

float SpotCone::at(float cosine) const {
  const float a = std::clamp(cosine * scale + offset, 0.0f, 1.0f);
  return a * a;
}

std::vector<VplId> emitterIds(const LightSet& lights) {
  std::map<NodeId, uint32_t> ofNode;
  std::vector<VplId> ids;
  for (const Emitter& e : lights.emitters()) ids.push_back({e.node, ofNode[e.node]++, 0, 0});
  return ids;
}

EmitterSample sampleEmitter(const RenderScene& scene, const LightSet& lights,
                            const SampleStreams& numbers, const PathWalker::Source& source,
                            uint32_t index, uint32_t set) {
  const Emitter& e = lights.emitters()[static_cast<size_t>(source.emitter)];
  const uint32_t parts = e.bothSides ? 2 : 1;  // the sides alternate
  const EmitterPoint at = lights.samplePoint(
      scene, source.emitter,
      numbers.point(source.id, index / parts, SampleStreams::kPlaceDimension, set));
  const float side = index % parts == 0 ? 1.0f : -1.0f;
  EmitterSample p;
  p.normal = side * at.normal;
  p.position = at.position + rayEpsilon(at.position) * p.normal;
  p.flux = kPi * at.area * static_cast<float>(parts) * (e.reference * at.share);
  p.area = at.area * static_cast<float>(parts);
  return p;
}

float Departure::density(const vec3& towards) const {
  const float cosine = glm::dot(normal, towards);
  switch (spread) {
    case Spread::cosine:
      return std::max(cosine, 0.0f) / kPi;
    case Spread::cap:
      return cosine >= 1.0f - cap ? 1.0f / (2.0f * kPi * cap) : 0.0f;
    case Spread::parallel:
      break;
  }
  return 0.0f;
}

PathWalker::PathWalker(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                       const VplCounts& counts)
    : scene_(scene),
      rays_(rays),
      lights_(lights),
      numbers_(counts),
      bounces_(static_cast<size_t>(std::max(counts.bounces, 0))),
      parallelStart_(scene, lights.sceneCentre(), lights.sceneRadius()) {}

Departure PathWalker::depart(const Source& source, uint32_t index) const {
  const Emitter& e = lights_.emitters()[static_cast<size_t>(source.emitter)];
  const vec2 u =
      numbers_.point(source.id, index, SampleStreams::kDirectionDimension, SampleStreams::indirect);
  switch (e.kind) {
    case EmitterKind::surface:
      return departSurface(source, index, u);
    case EmitterKind::punctual:
      return departPunctual(source, scene_.punctuals[e.punctual], index, u);
    case EmitterKind::sky:
      break;
  }
  const SkyMap::Light light =
      e.skySun > 0 ? lights_.referenceSky().sun(e.skySun - 1, u) : lights_.referenceSky().sample(u);
  return departParallel(source, light.towards, light.irradiance, index);
}

float PathWalker::reference(const Source& source) const {
  return lights_.emitters()[static_cast<size_t>(source.emitter)].reference;
}

Departure PathWalker::departSurface(const Source& source, uint32_t index, vec2 u) const {
  const EmitterSample p =
      sampleEmitter(scene_, lights_, numbers_, source, index, SampleStreams::indirect);
  Departure d;
  d.origin = p.position;
  d.normal = p.normal;
  d.flux = p.flux;
  d.direction = directionFrom(d, u);
  return d;
}

Departure PathWalker::departPunctual(const Source& source, const RenderPunctual& p, uint32_t index,
                                     vec2 u) const {
  if (p.light.kind == PunctualKind::directional)
    return departParallel(source, -p.direction, vec3(reference(source)), index);
  Departure d;
  d.origin = p.position;
  d.spread = Departure::Spread::cap;
  if (p.light.profile) {
    d.normal = p.direction;
    d.cap = p.light.profile->cap;
    d.direction = directionFrom(d, u);
    d.flux = fluxAlong(source, d, d.direction);
    return d;
  }
  if (p.light.kind == PunctualKind::point) {
    d.direction = sampleSphere(u);
    d.flux = vec3(4.0f * kPi * reference(source));
    return d;
  }
  d.normal = p.direction;
  d.cap = 1.0f - std::cos(p.light.outerCone);
  const vec3 local = sampleCap(d.cap, u);
  d.direction = Frame(p.direction).toWorld(local);
  d.flux = vec3(2.0f * kPi * d.cap * SpotCone(p.light).at(local.z) * reference(source));
  return d;
}

// Starts at the edge of the scene, preferably towards detailed parts of the level: flux = E /
// density.
Departure PathWalker::departParallel(const Source& source, const vec3& towards,
                                     const vec3& irradiance, uint32_t index) const {
  const DirectionalOrigins::Point p = parallelStart_.sample(
      towards,
      numbers_.point(source.id, index, SampleStreams::kPlaceDimension, SampleStreams::indirect),
      numbers_.point(source.id, index, kChoiceDimension, SampleStreams::indirect).x);
  Departure d;
  d.origin = p.position + lights_.sceneRadius() * towards;
  d.direction = d.normal = -towards;
  d.flux = irradiance / p.pdf;
  d.spread = Departure::Spread::parallel;
  return d;
}

vec3 PathWalker::directionFrom(const Departure& start, vec2 u) const {
  switch (start.spread) {
    case Departure::Spread::cosine:
      return Frame(start.normal).toWorld(sampleCosineHemisphere(u));
    case Departure::Spread::cap:
      return Frame(start.normal).toWorld(sampleCap(start.cap, u));
    case Departure::Spread::parallel:
      break;
  }
  return start.direction;
}

vec3 PathWalker::fluxAlong(const Source& source, const Departure& start,
                           const vec3& direction) const {
  const Emitter& e = lights_.emitters()[static_cast<size_t>(source.emitter)];
  if (e.kind != EmitterKind::punctual) return start.flux;
  const RenderPunctual& p = scene_.punctuals[e.punctual];
  if (p.light.profile) {
    const float share = p.light.profile->at(glm::transpose(p.axes) * direction);
    return vec3(2.0f * kPi * start.cap * share * e.reference);
  }
  if (p.light.kind != PunctualKind::spot) return start.flux;
  const float attenuation = SpotCone(p.light).at(glm::dot(p.direction, direction));
  return vec3(2.0f * kPi * start.cap * attenuation * e.reference);
}

PathStep PathWalker::step(const vec3& origin, const vec3& direction) const {
  PathStep s;
  s.origin = origin;
  s.direction = direction;
  s.hit = rays_.intersect({origin, 0.0f, direction});
  if (!s.hit) return s;
  const Surface at = surfaceAt(scene_, s.hit.object, s.hit.triangle, s.hit.u, s.hit.v);
  s.albedo = at.albedo;
  s.normal =
      glm::dot(at.geometricNormal, direction) < 0.0f ? at.geometricNormal : -at.geometricNormal;
  s.position = at.position + rayEpsilon(at.position) * s.normal;
  return s;
}

void PathWalker::receive(const Source& source, PathStep& first) const {
  const uint32_t link = lights_.emitters()[static_cast<size_t>(source.emitter)].link;
  if (first.hit && isLeftOut(scene_.objects[first.hit.object].leftOutBy, link))
    first.albedo = vec3(0.0f);
}

int PathWalker::walk(const Source& source, const Departure& departure, LightPath& path) const {
  path.flux = departure.flux;
  path.steps.clear();
  if (bounces_ == 0) return 0;
  path.steps.push_back(step(departure.origin, departure.direction));
  receive(source, path.steps.front());
  return 1 + walkOn(source, path, 1);
}

int PathWalker::walkOn(const Source& source, LightPath& path, size_t from) const {
  int rays = 0;
  if (from < path.steps.size()) {
    path.steps.resize(from + 1);
    path.steps[from] = step(path.steps[from].origin, path.steps[from].direction);
    if (from == 0) receive(source, path.steps[0]);
    ++rays;
  }
  for (; path.steps.size() < bounces_; ++rays) {
    const PathStep& last = path.steps.back();
    if (last.ends()) break;
    const auto bounce = static_cast<uint32_t>(path.steps.size());
    const vec2 u =
        numbers_.point(source.id, path.index, SampleStreams::kDirectionDimension + bounce,
                       SampleStreams::indirect);
    const vec3 direction = Frame(last.normal).toWorld(sampleCosineHemisphere(u));
    path.steps.push_back(step(last.position, direction));
  }
  return rays;
}

size_t vplCount(const LightPath& path) {
  vec3 flux = path.flux;
  size_t count = 0;
  for (const PathStep& s : path.steps) {
    if (!s.hit) break;
    flux *= s.albedo;
    if (isBlack(flux)) break;
    ++count;
  }
  return count;
}

void addVpls(const SampleStreams& numbers, const VplId& light, const LightPath& path, float share,
             bool isTurned, std::vector<SceneVpl>& vpls) {
  VplId id = light;
  id.index = path.index;
  vec3 flux = path.flux;
  for (const PathStep& s : path.steps) {
    if (!s.hit) return;
    flux *= s.albedo;
    if (isBlack(flux)) return;
    ++id.bounce;
    const vec3 tangent = isTurned ? numbers.turnedTangent(id, s.normal) : vec3(0.0f);
    SceneVpl& made = vpls.emplace_back();
    made.vpl = {vec4(s.position, shared::kVplCosine), vec4(s.normal, 0.0f), vec4(tangent, 1.0f),
                share * (flux / kPi), -1};
    made.id = id;
  }
}

}  // namespace lamplighter
