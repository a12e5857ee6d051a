#include "renderer/methods/path_tracer/light_samples.h"

#include <algorithm>
#include <cmath>

#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_linking.h"

namespace lamplighter {

namespace {

// The balance heuristic (Veach and Guibas 1995) for two strategies of one sample each.
float misWeight(float pdf, float other) { return pdf / (pdf + other); }

vec3 towards(const LocalSurface& at, const RenderPunctual& light, float& distance) {
  distance = std::numeric_limits<float>::infinity();
  if (light.light.kind == PunctualKind::directional) return -light.direction;
  const vec3 d = light.position - at.s.position;
  distance = glm::length(d);
  return d / std::max(distance, 1e-20f);
}

// Reflected radiance [W/(m² sr)] without occlusion.
vec3 unshadowed(const LocalSurface& at, const RenderPunctual& light) {
  float distance = 0.0f;
  const vec3 w = towards(at, light, distance);
  vec3 radiance = light.light.intensity * at.reflected(w);
  if (light.light.kind == PunctualKind::directional) return radiance;
  if (distance <= 0.0f) return vec3(0.0f);
  radiance /= distance * distance;
  if (light.light.profile)
    return radiance * light.light.profile->at(glm::transpose(light.axes) * -w);
  if (light.light.kind == PunctualKind::spot) {
    // KHR_lights_punctual: linear in the cosine between the two cones, then squared.
    const float co = std::cos(light.light.outerCone), ci = std::cos(light.light.innerCone);
    const float t =
        std::clamp((-glm::dot(w, light.direction) - co) / std::max(1e-3f, ci - co), 0.0f, 1.0f);
    radiance *= t * t;
  }
  return radiance;
}

// unshadowed(), but 0 for lights that light linking excludes.
vec3 given(const LocalSurface& at, const RenderPunctual& light) {
  return isLeftOut(at.leftOutBy, light.link) ? vec3(0.0f) : unshadowed(at, light);
}

}  // namespace

vec3 LightSamples::emissionSeen(const Hit& hit, const Surface& surface, const vec3& direction,
                                const vec3& from, float pdfDirection) const {
  const float cosine = -glm::dot(surface.geometricNormal, direction);
  if (surface.emission == vec3(0.0f) || (cosine <= 0.0f && !surface.emitsBothSides))
    return vec3(0.0f);
  if (pdfDirection == 0.0f) return surface.emission;
  const int emitter = lights_.emitterOfObject(hit.object);
  if (emitter == kNone) return surface.emission;
  const vec3 d = surface.position - from;
  const float area = lights_.areaAt(emitter, hit.triangle, vec2(hit.u, hit.v));
  const float pdfLight =
      lights_.surfaceProbability(from, emitter) / area * glm::dot(d, d) / std::abs(cosine);
  return surface.emission * misWeight(pdfDirection, pdfLight);
}

vec3 LightSamples::skySeen(const vec3& direction, float pdfDirection) const {
  const vec3 radiance = scene_.sky.radianceFrom(direction);
  if (pdfDirection == 0.0f || lights_.sky().isConstant() || radiance == vec3(0.0f)) return radiance;
  return radiance * misWeight(pdfDirection, lights_.sky().density(direction));
}

vec3 LightSamples::direct(const LocalSurface& at, PathSampler& sampler) {
  const bool samplesSky = !scene_.sky.isBlack() && !lights_.sky().isConstant() &&
                          !isLeftOut(at.leftOutBy, scene_.skyLink);
  const bool isBlack = at.s.albedo == vec3(0.0f) && !at.gloss;
  float choice = 0.0f, punctualChoice = 0.0f;
  vec2 u(0.0f), skyChoice(0.0f);
  if (isBlack || lights_.emitters().empty()) {
    sampler.skip();
    sampler.skip();
  } else {
    choice = sampler.next1();
    u = sampler.next2();
  }
  if (isBlack || scene_.punctuals.empty())
    sampler.skip();
  else
    punctualChoice = sampler.next1();
  if (isBlack && samplesSky)
    sampler.skip();
  else if (samplesSky)
    skyChoice = sampler.next2();
  if (isBlack) return vec3(0.0f);
  float probability = 0.0f;
  const int emitter = lights_.chooseSurface(at.s.position, choice, probability);
  vec3 radiance = fromPunctuals(at, punctualChoice), w;
  if (emitter != kNone &&
      !isLeftOut(at.leftOutBy, lights_.emitters()[static_cast<size_t>(emitter)].link))
    radiance += fromSurface(at, emitter, u, w) / probability;
  if (samplesSky) radiance += fromSky(at, skyChoice, w);
  return radiance;
}

bool LightSamples::visible(const LocalSurface& at, const vec3& direction, float distance) {
  ++raysTraced_;
  return !rays_.occluded({rayOrigin(at), 0.0f, direction, distance});
}

// Both ends are offset from their surfaces. Stopping before the light would not be sufficient: a
// ray that starts off its surface meets a light at a grazing angle well before its end.
bool LightSamples::visible(const LocalSurface& at, const EmitterPoint& p, const vec3& toLight) {
  const float side = glm::dot(p.normal, toLight) > 0.0f ? -1.0f : 1.0f;
  const vec3 way = p.position + side * rayEpsilon(p.position) * p.normal - rayOrigin(at);
  const float distance = glm::length(way);
  return distance <= 0.0f || visible(at, way / distance, distance);
}

vec3 LightSamples::fromSurface(const LocalSurface& at, int emitter, vec2 u, vec3& w) {
  const EmitterPoint p = lights_.samplePoint(scene_, emitter, u);
  const vec3 d = p.position - at.s.position;
  const float d2 = glm::dot(d, d);
  if (d2 <= 0.0f) return vec3(0.0f);
  const float distance = std::sqrt(d2);
  w = d / distance;
  const vec3 reflected = at.reflected(w);
  const float cosThere = p.bothSides ? std::abs(glm::dot(p.normal, w)) : -glm::dot(p.normal, w);
  if (reflected == vec3(0.0f) || cosThere <= 0.0f) return vec3(0.0f);
  if (!visible(at, p, w)) return vec3(0.0f);
  const float pdfAngle = p.pdfArea * d2 / cosThere;  // density per solid angle
  const float pdfLight = pdfAngle * lights_.surfaceProbability(at.s.position, emitter);
  return p.radiance * reflected * (misWeight(pdfLight, at.pdf(w)) / pdfAngle);
}

vec3 LightSamples::fromSky(const LocalSurface& at, vec2 u, vec3& w) {
  const SkyMap::Direction sky = lights_.sky().sampleDensity(u);
  w = sky.towards;
  const vec3 reflected = at.reflected(sky.towards);
  if (reflected == vec3(0.0f) || sky.pdf <= 0.0f) return vec3(0.0f);
  if (!visible(at, sky.towards, std::numeric_limits<float>::infinity())) return vec3(0.0f);
  return scene_.sky.radianceFrom(sky.towards) * reflected *
         (misWeight(sky.pdf, at.pdf(sky.towards)) / sky.pdf);
}

// Chooses one, with a probability proportional to its unshadowed contribution here; then only
// visibility causes noise.
vec3 LightSamples::fromPunctuals(const LocalSurface& at, float u) {
  float total = 0.0f;
  for (const RenderPunctual& light : scene_.punctuals) total += luminance(given(at, light));
  if (total <= 0.0f) return vec3(0.0f);
  const RenderPunctual* chosen = nullptr;
  float weight = 0.0f, below = 0.0f;
  for (const RenderPunctual& light : scene_.punctuals) {
    const float w = luminance(given(at, light));
    if (w <= 0.0f) continue;
    chosen = &light;
    weight = w;
    below += w;
    if (u * total < below) break;
  }
  float distance = 0.0f;
  const vec3 w = towards(at, *chosen, distance);
  if (!visible(at, w, distance)) return vec3(0.0f);
  return unshadowed(at, *chosen) * (total / weight);
}

vec3 LightSamples::fromPunctual(const LocalSurface& at, const RenderPunctual& light, vec3& w) {
  float distance = 0.0f;
  w = towards(at, light, distance);
  const vec3 open = unshadowed(at, light);
  return open != vec3(0.0f) && visible(at, w, distance) ? open : vec3(0.0f);
}

}  // namespace lamplighter
