#include "renderer/methods/path_tracer/path_tracer.h"

#include <algorithm>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/methods/path_tracer/light_samples.h"
#include "renderer/scene/light_linking.h"

namespace lamplighter {

namespace {

// Whether surface number `depth` of a path, counted from the camera, may have a specular lobe.
bool mayHaveLobe(int depth, const PathTracerOptions& options) {
  return depth > 0 ? options.glossyBounces : options.speculars && !options.lightOnly;
}

class Tracer {
 public:
  Tracer(const RenderScene& scene, const RayCaster& rays, const LightSet& lights)
      : scene_(scene), rays_(rays), lights_(lights), samples_(scene, rays, lights) {}

  // The origin of a ray: the camera or a surface.
  struct Start {
    int depth = 0;
    float pdf = 0.0f;  // density per solid angle with which the surface chose the direction
    vec3 place{0.0f};
    uint32_t leftOutBy = 0;
  };
  // Known light at which a path may end.
  struct End {
    const KnownLight& known;
    bool isWhole;                  // the path continues nevertheless
    std::optional<vec3> radiance;  // of the path if it ended there
  };
  vec3 trace(Ray ray, PathSampler& sampler, const PathTracerOptions& options, const Start& start,
             End* end = nullptr) {
    vec3 radiance(0.0f), throughput(1.0f);
    // Density per solid angle with which the last surface chose this direction; 0 for camera rays,
    // which do not compete with light sampling.
    float pdfDirection = start.pdf;
    vec3 from = start.place;
    uint32_t leftOutBy = start.leftOutBy;  // of the ray's origin; nothing is excluded for the eye

    const int bounces = options.part == LightPart::direct ? 0 : options.bounces;
    for (int depth = start.depth;; ++depth) {
      // Light that emitters send to the camera, or to the first visible surface, is direct.
      const bool takesSeen =
          depth == 0 ? options.seesLights : options.part != LightPart::indirect || depth > 1;
      ++raysTraced_;
      const Hit hit = rays_.intersect(ray, depth == 0 ? Surfaces::seen : Surfaces::all);
      if (!hit) {
        const bool seesSky = takesSeen && !isLeftOut(leftOutBy, scene_.skyLink);
        return seesSky ? radiance + throughput * samples_.skySeen(ray.direction, pdfDirection)
                       : radiance;
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
        radiance +=
            throughput * samples_.emissionSeen(hit, surface, ray.direction, from, pdfDirection);
      // Direct light is reflected once on its way to the camera (depth 0); each bounce adds one
      // reflection.
      if (depth > bounces) return radiance;
      if (end != nullptr && !end->radiance && depth > 0) {
        const float cosine = std::abs(glm::dot(at.ng, ray.direction));
        const float spread = hit.t * hit.t / std::max(pdfDirection * cosine, 1e-20f);
        if (const auto known = end->known.reflectedAt(ray, hit, spread)) {
          end->radiance = radiance + throughput * *known;
          if (!end->isWhole) return radiance;
        }
      }

      const vec3 direct = samples_.direct(at, sampler);
      if (options.part != LightPart::indirect || depth > 0) radiance += throughput * direct;

      // Next direction: cosine about the shading normal, with f · cos / pdf = ρ; or, if the surface
      // has a lobe, a mixture of cosine and lobe.
      const vec2 u = sampler.next2();
      const vec3 direction = at.gloss ? at.gloss->sample(sampler.next1(), u)
                                      : Frame(at.ns).toWorld(sampleCosineHemisphere(u));
      const float pdf = at.pdf(direction);
      if (glm::dot(at.ng, direction) <= 0.0f || !(pdf > 0.0f)) return radiance;
      throughput *= at.gloss ? at.reflected(direction) / pdf : at.s.albedo;
      if (depth >= options.sureBounces) {
        const float survive = std::min(0.95f, std::max({throughput.r, throughput.g, throughput.b}));
        if (sampler.next1() >= survive) return radiance;
        throughput /= survive;
      }
      if (throughput == vec3(0.0f)) return radiance;
      pdfDirection = pdf;
      from = at.s.position;
      leftOutBy = at.leftOutBy;
      ray = {rayOrigin(at), 0.0f, direction};
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
    const vec3 direct = samples_.direct(at, sampler);
    const vec3 direction = Frame(at.ns).toWorld(sampleCosineHemisphere(sampler.next2()));
    const float pdf = at.pdf(direction);
    if (glm::dot(at.ng, direction) <= 0.0f || !(pdf > 0.0f)) return kPi * direct;
    return kPi * (direct + trace({rayOrigin(at), 0.0f, direction}, sampler, options,
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
    const int emitter = lights_.chooseSurface(position, choice, probability);
    if (emitter != kNone)
      out[1].light = samples_.fromSurface(at, emitter, onEmitter, out[1].towards) / probability;
    if (!scene_.sky.isBlack() && !lights_.sky().isConstant())
      out[2].light = samples_.fromSky(at, inSky, out[2].towards);
    return out;
  }

  ArrivingLight arriving(const vec3& position, const RenderPunctual& light) {
    ArrivingLight out;
    out.light = samples_.fromPunctual(LocalSurface(position), light, out.towards);
    return out;
  }

  uint64_t raysTraced() const { return raysTraced_ + samples_.raysTraced(); }

 private:
  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  LightSamples samples_;
  uint64_t raysTraced_ = 0;
};

// Through a point of the pixel.
Ray cameraRay(const View& view, int x, int y, PathSampler& sampler,
              const PathTracerOptions& options) {
  const vec2 random = sampler.next2();
  const vec2 inPixel = options.inPixel.value_or(random);
  return {view.eye, 0.0f,
          view.rayDirection(static_cast<float>(x) + inPixel.x, static_cast<float>(y) + inPixel.y)};
}

}  // namespace

vec3 tracePath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
               const View& view, int x, int y, uint32_t sample, const PathTracerOptions& options,
               uint64_t* raysTraced) {
  PathSampler sampler(static_cast<uint32_t>(y * view.width + x), sample, options.seed);
  const Ray ray = cameraRay(view, x, y, sampler, options);
  Tracer tracer(scene, caster, lights);
  const vec3 radiance = tracer.trace(ray, sampler, options, {});
  if (raysTraced != nullptr) *raysTraced += tracer.raysTraced();
  return radiance;
}

EndedPath traceEndedPath(const RenderScene& scene, const RayCaster& caster, const LightSet& lights,
                         const View& view, int x, int y, uint32_t sample,
                         const PathTracerOptions& options, const KnownLight& known, bool isWhole,
                         uint64_t* raysTraced) {
  PathSampler sampler(static_cast<uint32_t>(y * view.width + x), sample, options.seed);
  const Ray ray = cameraRay(view, x, y, sampler, options);
  Tracer tracer(scene, caster, lights);
  Tracer::End end{known, isWhole, {}};
  const vec3 radiance = tracer.trace(ray, sampler, options, {}, &end);
  if (raysTraced != nullptr) *raysTraced += tracer.raysTraced();
  if (!end.radiance) return {radiance, vec3(0.0f)};
  return {*end.radiance, isWhole ? radiance - *end.radiance : vec3(0.0f)};
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
