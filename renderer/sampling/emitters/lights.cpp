#include "renderer/sampling/emitters/lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

float triangleArea(const RenderScene& s, const RenderObject& o, uint32_t t) {
  const uint32_t* i = &s.indices[o.firstIndex + 3 * t];
  return 0.5f * glm::length(glm::cross(s.positions[i[1]] - s.positions[i[0]],
                                       s.positions[i[2]] - s.positions[i[0]]));
}

// Reuses the brightness of the same mesh and texture, or computes it.
std::shared_ptr<const CellBrightness> brightnessOf(const RenderScene& s, uint32_t object,
                                                   std::span<const Emitter> before,
                                                   std::span<const Emitter> now) {
  CellBrightness::Key key(s, object);
  for (const std::span<const Emitter> known : {before, now}) {
    for (const Emitter& e : known) {
      if (!e.cells.empty() && e.cells.brightness()->key == key) return e.cells.brightness();
    }
  }
  return std::make_shared<const CellBrightness>(s, object, std::move(key));
}

Emitter surfaceEmitter(const RenderScene& s, uint32_t object, std::span<const Emitter> before,
                       std::span<const Emitter> now) {
  const RenderObject& o = s.objects[object];
  const Material& m = s.materials[o.material];
  Emitter e;
  e.object = object;
  e.node = o.node;
  e.bothSides = m.doubleSided;
  e.link = o.link;
  std::vector<float> areas(o.triangleCount());
  for (uint32_t t = 0; t < areas.size(); ++t) areas[t] = triangleArea(s, o, t);
  const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
  e.triangles = AliasTable(areas);
  if (e.triangles.empty()) return e;
  e.area = static_cast<float>(area);
  vec3 radiance = m.emissive;
  if (m.emissiveTexture.texture != kNone || m.alphaMode == AlphaMode::mask) {
    e.cells = EmitterCells(brightnessOf(s, object, before, now), areas);
    glm::dvec3 sum(0.0);
    for (uint32_t t = 0; t < areas.size() && !e.cells.empty(); ++t)
      sum += static_cast<double>(areas[t]) * glm::dvec3(e.cells.brightness()->mean[t]);
    radiance *= vec3(sum / area);
  }
  e.flux = kPi * e.area * (e.bothSides ? 2.0f : 1.0f) * radiance;
  return e;
}

// Solid angle of the cone weighted by KHR_lights_punctual's falloff, ((cos θ − cos o)/(cos i − cos
// o))² between outer and inner cone: ∫ = 2π [(1 − cos i) + (cos i − cos o)/3].
float spotSolidAngle(const PunctualLight& l) {
  const float ci = std::cos(l.innerCone), co = std::cos(l.outerCone);
  return 2.0f * kPi * ((1.0f - ci) + (ci - co) / 3.0f);
}

vec3 punctualFlux(const PunctualLight& l, float sceneRadius) {
  if (l.profile) return l.profile->solidAngle * l.intensity;
  switch (l.kind) {
    case PunctualKind::point:
      return 4.0f * kPi * l.intensity;
    case PunctualKind::spot:
      return spotSolidAngle(l) * l.intensity;
    case PunctualKind::directional:
      return kPi * sceneRadius * sceneRadius * l.intensity;
  }
  return vec3(0.0f);
}

}  // namespace

LightSet::LightSet(const RenderScene& s, const LightSet& before) {
  centre_ = s.bounds.centre();
  radius_ = s.bounds.radius();
  emitterOfObject_.assign(s.objects.size(), kNone);
  for (uint32_t i = 0; i < s.objects.size(); ++i) {
    const Material& m = s.materials[s.objects[i].material];
    if (!m.emits() || m.isClear()) continue;
    Emitter e = surfaceEmitter(s, i, before.emitters_, emitters_);
    if (e.triangles.empty() || luminance(e.flux) <= 0.0f) continue;  // no area, or black
    emitterOfObject_[i] = static_cast<int>(emitters_.size());
    emitters_.push_back(std::move(e));
  }
  for (uint32_t i = 0; i < s.punctuals.size(); ++i) {
    Emitter e;
    e.kind = EmitterKind::punctual;
    e.node = s.punctuals[i].node;
    e.punctual = i;
    e.link = s.punctuals[i].link;
    e.flux = punctualFlux(s.punctuals[i].light, radius_);
    if (luminance(e.flux) > 0.0f) emitters_.push_back(std::move(e));
  }
  sky_ = SkySampler(s.sky);
  for (uint32_t sun = 0; !s.sky.isBlack() && sun <= sky_.sunCount(); ++sun) {
    Emitter e;
    e.kind = EmitterKind::sky;
    e.skySun = sun;
    e.link = s.skyLink;
    e.flux =
        kPi * radius_ * radius_ * (sun == 0 ? sky_.irradiance() : sky_.sun(sun - 1).irradiance);
    if (luminance(e.flux) > 0.0f) emitters_.push_back(std::move(e));
  }
  std::vector<float> weights(emitters_.size());
  std::transform(emitters_.begin(), emitters_.end(), weights.begin(), [](const Emitter& e) {
    return e.kind == EmitterKind::surface ? luminance(e.flux) : 0.0f;
  });
  choice_ = AliasTable(weights);
}

int LightSet::chooseSurface(float u, float& probability) const {
  if (choice_.empty()) return kNone;
  float rest;
  const size_t i = choice_.sample(u, rest);
  probability = choice_.probability(i);
  return static_cast<int>(i);
}

float LightSet::surfaceProbability(int emitter) const {
  return choice_.probability(static_cast<size_t>(emitter));
}

int LightSet::emitterOfObject(uint32_t object) const { return emitterOfObject_[object]; }

EmitterPoint LightSet::samplePoint(const RenderScene& s, int emitter, vec2 u) const {
  const Emitter& e = emitters_[static_cast<size_t>(emitter)];
  EmitterCells::Point at;
  if (e.cells.empty()) {
    float rest;
    at.triangle = static_cast<uint32_t>(e.triangles.sample(u.x, rest));
    at.weights = sampleTriangle({rest, u.y});
    at.area = e.area;
  } else {
    at = e.cells.sample(u);
  }
  const Surface surface = surfaceAt(s, e.object, at.triangle, at.weights.x, at.weights.y);
  EmitterPoint p;
  p.position = surface.position;
  p.normal = surface.geometricNormal;
  p.radiance = surface.emission;
  if (!e.cells.empty())
    p.radiance = s.materials[s.objects[e.object].material].emissive *
                 emissionShareAt(s, e.object, at.triangle, at.weights.x, at.weights.y);
  p.area = at.area;
  p.pdfArea = 1.0f / at.area;
  p.bothSides = e.bothSides;
  return p;
}

float LightSet::areaAt(int emitter, uint32_t triangle, vec2 weights) const {
  const Emitter& e = emitters_[static_cast<size_t>(emitter)];
  return e.cells.empty() ? e.area : e.cells.areaAt(triangle, weights);
}

}  // namespace lamplighter
