#include "renderer/sampling/emitters/lights.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <utility>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/reference_brightness.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

float triangleArea(const RenderScene& s, const RenderObject& o, uint32_t t) {
  const uint32_t* i = &s.indices[o.firstIndex + 3 * t];
  return 0.5f * glm::length(glm::cross(s.positions[i[1]] - s.positions[i[0]],
                                       s.positions[i[2]] - s.positions[i[0]]));
}

void setReference(Emitter& e, const vec3& nominal, const vec3& actual) {
  e.reference = referenceBrightness(nominal);
  e.gain = e.reference > 0.0f ? actual / e.reference : vec3(0.0f);
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
  const vec3 nominal = s.nominalEmission[static_cast<size_t>(o.material)];
  setReference(e, nominal, m.emissive);
  vec3 share(1.0f);
  if (m.emissiveTexture.texture != kNone || m.alphaMode == AlphaMode::mask) {
    e.cells = EmitterCells(brightnessOf(s, object, before, now), areas);
    glm::dvec3 sum(0.0);
    for (uint32_t t = 0; t < areas.size() && !e.cells.empty(); ++t)
      sum += static_cast<double>(areas[t]) * glm::dvec3(e.cells.brightness()->mean[t]);
    share = vec3(sum / area);
  }
  const float perRadiance = kPi * e.area * (e.bothSides ? 2.0f : 1.0f);
  e.flux = perRadiance * (m.emissive * share);
  e.referenceFlux = luminance(perRadiance * (e.reference * share));
  // A light may be black because of its colour and that of its texture.
  if (!(luminance(nominal * share) > 0.0f)) e.referenceFlux = 0.0f;
  return e;
}

// Solid angle of the cone weighted by KHR_lights_punctual's falloff, ((cos θ − cos o)/(cos i − cos
// o))² between outer and inner cone: ∫ = 2π [(1 − cos i) + (cos i − cos o)/3].
float spotSolidAngle(const PunctualLight& l) {
  const float ci = std::cos(l.innerCone), co = std::cos(l.outerCone);
  return 2.0f * kPi * ((1.0f - ci) + (ci - co) / 3.0f);
}

float fluxPerIntensity(const PunctualLight& l, float sceneRadius) {
  if (l.profile) return l.profile->solidAngle;
  switch (l.kind) {
    case PunctualKind::point:
      return 4.0f * kPi;
    case PunctualKind::spot:
      return spotSolidAngle(l);
    case PunctualKind::directional:
      return kPi * sceneRadius * sceneRadius;
  }
  return 0.0f;
}

}  // namespace

LightSet::LightSet(const RenderScene& s, const LightSet& before) {
  centre_ = s.bounds.centre();
  radius_ = s.bounds.radius();
  emitterOfObject_.assign(s.objects.size(), kNone);
  for (uint32_t i = 0; i < s.objects.size(); ++i) {
    const auto material = static_cast<size_t>(s.objects[i].material);
    if (!(luminance(s.nominalEmission[material]) > 0.0f) || s.materials[material].isClear())
      continue;
    Emitter e = surfaceEmitter(s, i, before.emitters_, emitters_);
    if (e.triangles.empty() || e.referenceFlux <= 0.0f) continue;  // no area, or black
    emitterOfObject_[i] = static_cast<int>(emitters_.size());
    emitters_.push_back(std::move(e));
  }
  for (uint32_t i = 0; i < s.punctuals.size(); ++i) {
    Emitter e;
    e.kind = EmitterKind::punctual;
    e.node = s.punctuals[i].node;
    e.punctual = i;
    e.link = s.punctuals[i].link;
    const RenderPunctual& p = s.punctuals[i];
    setReference(e, p.nominal, p.light.intensity);
    const float perIntensity = fluxPerIntensity(p.light, radius_);
    e.flux = perIntensity * p.light.intensity;
    e.referenceFlux = perIntensity * e.reference;
    if (e.referenceFlux > 0.0f) emitters_.push_back(std::move(e));
  }
  sky_ = SkySampler(s.sky);
  if (!s.nominalSky.isBlack()) addSky(s);
  std::vector<float> weights(emitters_.size());
  std::transform(emitters_.begin(), emitters_.end(), weights.begin(), [](const Emitter& e) {
    return e.kind == EmitterKind::surface ? luminance(e.flux) : 0.0f;
  });
  choice_ = AliasTable(weights);
}

void LightSet::addSky(const RenderScene& s) {
  const float factor = skyReference_ = referenceBrightness(s.nominalSky.factor());
  const vec3 actual = s.sky.isBlack() ? vec3(0.0f) : s.sky.factor();
  referenceSky_ = SkySampler(s.nominalSky.withFactor(factor));
  for (uint32_t sun = 0; sun <= referenceSky_.sunCount(); ++sun) {
    Emitter e;
    e.kind = EmitterKind::sky;
    e.skySun = sun;
    e.link = s.skyLink;
    setReference(e, s.nominalSky.factor(), actual);
    const vec3 irradiance =
        sun == 0 ? referenceSky_.irradiance() : referenceSky_.sun(sun - 1).irradiance;
    const vec3 flux = kPi * radius_ * radius_ * irradiance;
    e.flux = e.gain * flux;
    e.referenceFlux = luminance(flux);
    if (e.referenceFlux > 0.0f) emitters_.push_back(std::move(e));
  }
}

Sky LightSet::unitSky() const {
  return skyReference_ > 0.0f ? referenceSky_.sky().withFactor(1.0f) : Sky();
}

LightSet LightSet::forPaths(const RenderScene& scene, const LightSet& before) {
  LightSet out(scene, before);
  const auto isLit = [](const Emitter& e) {
    return e.kind == EmitterKind::surface && luminance(e.flux) > 0.0f;
  };
  if (std::ranges::count_if(out.emitters_, isLit) > 1)
    out.byPlace_ = std::make_shared<EmitterChoice>(scene, out.emitters_);
  return out;
}

int LightSet::chooseSurface(const vec3& place, float u, float& probability) const {
  if (byPlace_) return byPlace_->choose(place, u, probability);
  if (choice_.empty()) return kNone;
  float rest;
  const size_t i = choice_.sample(u, rest);
  probability = choice_.probability(i);
  return static_cast<int>(i);
}

float LightSet::surfaceProbability(const vec3& place, int emitter) const {
  if (byPlace_) return byPlace_->probability(place, emitter);
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
  if (!e.cells.empty()) {
    p.share = emissionShareAt(s, e.object, at.triangle, at.weights.x, at.weights.y);
    p.radiance = s.materials[static_cast<size_t>(s.objects[e.object].material)].emissive * p.share;
  }
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
