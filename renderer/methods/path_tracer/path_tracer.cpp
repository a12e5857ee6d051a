#include "renderer/methods/path_tracer/path_tracer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/methods/path_tracer/glossy_surface.h"
#include "renderer/scene/ies/ies_profile.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

namespace {

// Russian roulette starts after this number of bounces; before it, no path is terminated.
constexpr int kSureBounces = 8;

// Of directions of the sphere [1/sr].
constexpr float kUniformDensity = 1.0f / (4.0f * kPi);

// The balance heuristic (Veach and Guibas 1995) for two strategies of one sample each.
float misWeight(float pdf, float other) { return pdf / (pdf + other); }

// Whether surface number `depth` of a path, counted from the camera, may have a specular lobe.
bool mayHaveLobe(int depth, const PathTracerOptions& options) {
  return depth > 0 ? options.glossyBounces : options.speculars && !options.lightOnly;
}

// A surface seen from one side: both normals are turned to the viewer. A mapped normal that faces
// away from the viewer is bent to the geometric one. Lambertian if it has no gloss.
struct LocalSurface {
  Surface s;
  vec3 ng, ns;
  std::optional<GlossySurface> gloss;
  uint32_t leftOutBy;    // light_linking.h
  bool isSpace = false;  // a point without surface, which takes all light alike

  LocalSurface(const Surface& surface, const vec3& toViewer, uint32_t links)
      : s(surface), leftOutBy(links) {
    const float side = glm::dot(s.geometricNormal, toViewer) < 0.0f ? -1.0f : 1.0f;
    ng = side * s.geometricNormal;
    ns = side * s.normal;
    if (glm::dot(ns, toViewer) <= 0.0f) ns = ng;
  }
  explicit LocalSurface(const vec3& place) : ng(0.0f), ns(0.0f), leftOutBy(0), isSpace(true) {
    s.position = place;
  }
  // Cosine with the shading normal; 0 for directions below the real surface, where light would
  // leak.
  float cosine(const vec3& w) const {
    return glm::dot(ng, w) > 0.0f ? std::max(0.0f, glm::dot(ns, w)) : 0.0f;
  }
  // f · cos for light from w; 1 in space.
  vec3 reflected(const vec3& w) const {
    if (isSpace) return vec3(1.0f);
    const vec3 f = gloss ? gloss->brdf(w) : s.albedo / kPi;
    return f * cosine(w);
  }
  // The probability density per solid angle with which a path continues towards w.
  float pdf(const vec3& w) const {
    if (isSpace) return kUniformDensity;
    return gloss ? gloss->pdf(w) : std::max(0.0f, glm::dot(ns, w)) / kPi;
  }
};

class Tracer {
 public:
  Tracer(const RenderScene& scene, const RayCaster& rays, const LightSet& lights)
      : scene_(scene), rays_(rays), lights_(lights) {}

  // The origin of a ray: the camera or a surface.
  struct Start {
    int depth = 0;
    float pdf = 0.0f;  // density per solid angle with which the surface chose the direction
    vec3 place{0.0f};
    uint32_t leftOutBy = 0;
  };
  vec3 trace(Ray ray, PathSampler& sampler, const PathTracerOptions& options, const Start& start) {
    vec3 radiance(0.0f), throughput(1.0f);
    // Density per solid angle with which the last surface chose this direction; 0 for camera rays,
    // which do not compete with light sampling.
    float pdfDirection = start.pdf;
    vec3 from = start.place;
    uint32_t leftOutBy = start.leftOutBy;  // of the ray's origin; nothing is excluded for the eye

    const int bounces = options.part == LightPart::direct ? 0 : options.bounces;
    for (int depth = start.depth;; ++depth) {
      // Light that emitters send to the camera, or to the first visible surface, is direct.
      const bool takesSeen = options.part != LightPart::indirect || depth > 1;
      ++raysTraced_;
      const Hit hit = rays_.intersect(ray, depth == 0 ? Surfaces::seen : Surfaces::all);
      if (!hit) {
        const bool seesSky = takesSeen && !isLeftOut(leftOutBy, scene_.skyLink);
        return seesSky ? radiance + throughput * skySeen(ray.direction, pdfDirection) : radiance;
      }
      Surface surface = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
      if (depth == 0 && options.lightOnly) surface.albedo = vec3(1.0f);
      const RenderObject& object = scene_.objects[hit.object];
      LocalSurface at(surface, -ray.direction, object.leftOutBy);
      if (mayHaveLobe(depth, options)) {
        const Gloss gloss = glossAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
        if (shared::isGlossy(gloss.metallic, gloss.roughness))
          at.gloss.emplace(
              surface.albedo, gloss, options.leastRoughness, at.ns, -ray.direction,
              options.glossyBounces ? LobeArithmetic::fromSine : LobeArithmetic::fromCosine);
      }
      if (takesSeen && !isLeftOut(leftOutBy, object.link))
        radiance += throughput * emissionSeen(hit, surface, ray.direction, from, pdfDirection);
      // Direct light is reflected once on its way to the camera (depth 0); each bounce adds one
      // reflection.
      if (depth > bounces) return radiance;

      const vec3 direct = directLight(at, sampler);
      if (options.part != LightPart::indirect || depth > 0) radiance += throughput * direct;

      // Next direction: cosine about the shading normal, with f · cos / pdf = ρ; or, if the surface
      // has a lobe, a mixture of cosine and lobe.
      const vec2 u = sampler.next2();
      const vec3 direction = at.gloss ? at.gloss->sample(sampler.next1(), u)
                                      : Frame(at.ns).toWorld(sampleCosineHemisphere(u));
      const float pdf = at.pdf(direction);
      if (glm::dot(at.ng, direction) <= 0.0f || !(pdf > 0.0f)) return radiance;
      throughput *= at.gloss ? at.reflected(direction) / pdf : at.s.albedo;
      if (depth >= kSureBounces) {
        const float survive = std::min(0.95f, std::max({throughput.r, throughput.g, throughput.b}));
        if (sampler.next1() >= survive) return radiance;
        throughput /= survive;
      }
      if (throughput == vec3(0.0f)) return radiance;
      pdfDirection = pdf;
      from = at.s.position;
      leftOutBy = at.leftOutBy;
      ray = {off(at), 0.0f, direction};
    }
  }

  // The reflected radiance of a white Lambertian surface there, times π.
  vec3 irradiance(const ReceivingPlace& place, PathSampler& sampler,
                  const PathTracerOptions& options) {
    Surface surface;
    surface.position = place.position;
    surface.geometricNormal = place.normal;
    surface.normal = place.shadingNormal;
    surface.albedo = vec3(1.0f);
    const LocalSurface at(surface, place.normal, place.leftOutBy);
    const vec3 direct = directLight(at, sampler);
    const vec3 direction = Frame(at.ns).toWorld(sampleCosineHemisphere(sampler.next2()));
    const float pdf = at.pdf(direction);
    if (glm::dot(at.ng, direction) <= 0.0f || !(pdf > 0.0f)) return kPi * direct;
    return kPi * (direct + trace({off(at), 0.0f, direction}, sampler, options,
                                 {1, pdf, place.position, place.leftOutBy}));
  }

  std::array<ArrivingLight, 3> arriving(const vec3& position, PathSampler& sampler,
                                        const PathTracerOptions& options) {
    const LocalSurface at(position);
    std::array<ArrivingLight, 3> out;
    out[0].towards = sampleSphere(sampler.next2());
    const float choice = sampler.next1();
    const vec2 onEmitter = sampler.next2(), inSky = sampler.next2();
    out[0].light =
        trace({position, 0.0f, out[0].towards}, sampler, options, {1, kUniformDensity, position}) /
        kUniformDensity;
    float probability = 0.0f;
    const int emitter = lights_.chooseSurface(choice, probability);
    if (emitter != kNone)
      out[1].light = fromSurface(at, emitter, onEmitter, out[1].towards) / probability;
    if (!scene_.sky.isBlack() && !lights_.sky().isConstant())
      out[2].light = fromSky(at, inSky, out[2].towards);
    return out;
  }

  ArrivingLight arriving(const vec3& position, const RenderPunctual& light) {
    const LocalSurface at(position);
    ArrivingLight out;
    float distance = 0.0f;
    out.towards = towards(at, light, distance);
    const vec3 open = unshadowed(at, light);
    if (open != vec3(0.0f) && visible(at, out.towards, distance)) out.light = open;
    return out;
  }

  uint64_t raysTraced() const { return raysTraced_; }

 private:
  // Emission of a surface that a ray hit, with the MIS weight against light sampling.
  vec3 emissionSeen(const Hit& hit, const Surface& surface, const vec3& direction, const vec3& from,
                    float pdfDirection) const {
    const float cosine = -glm::dot(surface.geometricNormal, direction);
    if (surface.emission == vec3(0.0f) || (cosine <= 0.0f && !surface.emitsBothSides))
      return vec3(0.0f);
    if (pdfDirection == 0.0f) return surface.emission;
    const int emitter = lights_.emitterOfObject(hit.object);
    if (emitter == kNone) return surface.emission;
    const vec3 d = surface.position - from;
    const float area = lights_.areaAt(emitter, hit.triangle, vec2(hit.u, hit.v));
    const float pdfLight =
        lights_.surfaceProbability(emitter) / area * glm::dot(d, d) / std::abs(cosine);
    return surface.emission * misWeight(pdfDirection, pdfLight);
  }

  // The sky's radiance for a ray that hits nothing, with the MIS weight against light sampling.
  vec3 skySeen(const vec3& direction, float pdfDirection) const {
    const vec3 radiance = scene_.sky.radianceFrom(direction);
    if (pdfDirection == 0.0f || lights_.sky().isConstant() || radiance == vec3(0.0f))
      return radiance;
    return radiance * misWeight(pdfDirection, lights_.sky().density(direction));
  }

  // Direct light from emitters, times f · cos: one sample of all emissive surfaces, one of all
  // punctual lights, one of the sky. A constant sky is not sampled here, because the
  // cosine-distributed bounce directions already sample it optimally.
  vec3 directLight(const LocalSurface& at, PathSampler& sampler) {
    const float choice = sampler.next1();
    const vec2 u = sampler.next2();
    const float punctualChoice = sampler.next1();
    const bool samplesSky = !scene_.sky.isBlack() && !lights_.sky().isConstant() &&
                            !isLeftOut(at.leftOutBy, scene_.skyLink);
    const vec2 skyChoice = samplesSky ? sampler.next2() : vec2(0.0f);
    if (at.s.albedo == vec3(0.0f) && !at.gloss) return vec3(0.0f);
    float probability = 0.0f;
    const int emitter = lights_.chooseSurface(choice, probability);
    vec3 radiance = fromPunctuals(at, punctualChoice), w;
    if (emitter != kNone &&
        !isLeftOut(at.leftOutBy, lights_.emitters()[static_cast<size_t>(emitter)].link))
      radiance += fromSurface(at, emitter, u, w) / probability;
    if (samplesSky) radiance += fromSky(at, skyChoice, w);
    return radiance;
  }

  bool visible(const LocalSurface& at, const vec3& direction, float distance) {
    ++raysTraced_;
    return !rays_.occluded({off(at), 0.0f, direction, distance});
  }

  // Both ends are offset from their surfaces. Stopping before the light would not be sufficient: a
  // ray that starts off its surface meets a light at a grazing angle well before its end.
  bool visible(const LocalSurface& at, const EmitterPoint& p, const vec3& toLight) {
    const float side = glm::dot(p.normal, toLight) > 0.0f ? -1.0f : 1.0f;
    const vec3 way = p.position + side * rayEpsilon(p.position) * p.normal - off(at);
    const float distance = glm::length(way);
    return distance <= 0.0f || visible(at, way / distance, distance);
  }

  static vec3 off(const LocalSurface& at) {
    return at.s.position + rayEpsilon(at.s.position) * at.ng;
  }

  // The unit vector towards the sample is put in w.
  vec3 fromSurface(const LocalSurface& at, int emitter, vec2 u, vec3& w) {
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
    const float pdfLight = pdfAngle * lights_.surfaceProbability(emitter);
    return p.radiance * reflected * (misWeight(pdfLight, at.pdf(w)) / pdfAngle);
  }

  vec3 fromSky(const LocalSurface& at, vec2 u, vec3& w) {
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
  vec3 fromPunctuals(const LocalSurface& at, float u) {
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

  static vec3 towards(const LocalSurface& at, const RenderPunctual& light, float& distance) {
    distance = std::numeric_limits<float>::infinity();
    if (light.light.kind == PunctualKind::directional) return -light.direction;
    const vec3 d = light.position - at.s.position;
    distance = glm::length(d);
    return d / std::max(distance, 1e-20f);
  }

  // unshadowed(), but 0 for lights that light linking excludes.
  static vec3 given(const LocalSurface& at, const RenderPunctual& light) {
    return isLeftOut(at.leftOutBy, light.link) ? vec3(0.0f) : unshadowed(at, light);
  }

  // Reflected radiance [W/(m² sr)] without occlusion.
  static vec3 unshadowed(const LocalSurface& at, const RenderPunctual& light) {
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

  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  uint64_t raysTraced_ = 0;
};

}  // namespace

vec3 tracePath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
               const View& view, int x, int y, uint32_t sample, const PathTracerOptions& options,
               uint64_t* raysTraced) {
  PathSampler sampler(static_cast<uint32_t>(y * view.width + x), sample, options.seed);
  const vec2 inPixel = sampler.next2();
  const vec3 direction =
      view.rayDirection(static_cast<float>(x) + inPixel.x, static_cast<float>(y) + inPixel.y);
  Tracer tracer(scene, caster, lights);
  const vec3 radiance = tracer.trace({view.eye, 0.0f, direction}, sampler, options, {});
  if (raysTraced != nullptr) *raysTraced += tracer.raysTraced();
  return radiance;
}

vec3 traceIrradiance(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                     const ReceivingPlace& place, uint32_t pixel, uint32_t sample,
                     const PathTracerOptions& options) {
  PathSampler sampler(pixel, sample, options.seed);
  return Tracer(scene, caster, lights).irradiance(place, sampler, options);
}

std::array<ArrivingLight, 3> traceArrivingLight(const RenderScene& scene, const RayCaster& caster,
                                                const LightSet& lights, const vec3& position,
                                                uint32_t pixel, uint32_t sample,
                                                const PathTracerOptions& options) {
  PathSampler sampler(pixel, sample, options.seed);
  return Tracer(scene, caster, lights).arriving(position, sampler, options);
}

ArrivingLight arrivingPunctual(const RenderScene& scene, const RayCaster& caster,
                               const LightSet& lights, const vec3& position,
                               const RenderPunctual& light) {
  return Tracer(scene, caster, lights).arriving(position, light);
}

}  // namespace lamplighter
