#include "renderer/bias_compensation/bias_compensation.h"

#include <algorithm>
#include <array>

#include <tbb/parallel_for.h>

#include "renderer/base/random.h"
#include "renderer/bias_compensation/seen_pixels.h"
#include "renderer/scene/light_linking.h"
#include "renderer/scene/vpl.h"
#include "shaders/shared/brdf.h"
#include "shaders/shared/vpl_shading.h"

namespace lamplighter {
namespace {

// Candidate VPLs for the hit point of a short ray, and shadow rays to the best of them. Too few
// cause noise along edges.
constexpr int kVplsTried = 32, kRaysAPoint = 2;
constexpr uint32_t kNoObject = 0xffffffffu;
// Share of the selection probability that ignores brightness: the irradiance of a sun and the
// intensity of a lamp are not comparable.
constexpr float kEvenChoices = 0.5f;

}  // namespace

BiasCompensation::BiasCompensation(const RenderScene& scene, const RayCaster& rays,
                                   std::span<const SceneVpl> vpls, const Options& options)
    : scene_(scene), rays_(rays), options_(options) {
  const auto groupOf = [&](size_t i) { return options.groups.empty() ? 0 : options.groups[i]; };
  for (size_t i = 0; i < vpls.size(); ++i) {
    const SceneVpl& v = vpls[i];
    if (!v.isOfSun()) continue;
    const auto isIt = [&](const Sun& sun) { return sun.set == v.id.set(); };
    if (std::none_of(suns_.begin(), suns_.end(), isIt))
      suns_.push_back({v.id.set(), vec3(v.vpl.normal), v.vpl.intensity,
                       static_cast<uint32_t>(v.vpl.footprint.y), groupOf(i)});
  }
  choices_.resize(static_cast<size_t>(std::max(options.bounces, 0)));
  for (size_t bounce = 0; bounce < choices_.size(); ++bounce) {
    Choice& choice = choices_[bounce];
    float total = 0.0f;
    for (size_t i = 0; i < vpls.size(); ++i) {
      if (vpls[i].id.bounce > bounce || vpls[i].isOfSun()) continue;
      choice.entries.push_back({vpls[i].vpl, brightness(vpls[i].vpl), 0.0f, groupOf(i)});
      total += choice.entries.back().brightness;
    }
    const float even = kEvenChoices / static_cast<float>(choice.entries.size());
    const float scale = total > 0.0f ? (1.0f - kEvenChoices) / total : 0.0f;
    float sum = 0.0f;
    for (const Choice::Entry& e : choice.entries)
      choice.upTo.push_back(sum += even + scale * e.brightness);
    for (size_t i = 0; i < choice.entries.size(); ++i) {
      const float probability = choice.upTo[i] - (i == 0 ? 0.0f : choice.upTo[i - 1]);
      Choice::Entry& e = choice.entries[i];
      e.weight = probability > 0.0f ? sum / probability : 0.0f;
      e.brightness *= e.weight;
    }
    choice.makeGuide();
  }
}

void BiasCompensation::Choice::makeGuide() {
  uint32_t i = 0;
  for (size_t part = 0; part < upTo.size(); ++part) {
    const float from = static_cast<float>(part) / static_cast<float>(upTo.size()) * upTo.back();
    while (i + 1 < upTo.size() && upTo[i] <= from) ++i;
    guide.push_back(i);
  }
}

size_t BiasCompensation::Choice::find(float below) const {
  const float part = below / upTo.back() * static_cast<float>(guide.size());
  size_t i = guide[std::min(static_cast<size_t>(part), guide.size() - 1)];
  // Rounding may have selected a later part.
  while (i > 0 && upTo[i - 1] > below) --i;
  while (i + 1 < upTo.size() && upTo[i] <= below) ++i;
  return i;
}

struct BiasCompensation::Sink {
  std::vector<Contribution>* contributions = nullptr;
  uint32_t pixel = 0;
  float scale = 1.0f;
  vec3 sum{0.0f};  // of all groups, if contributions are not wanted

  void add(uint32_t group, const vec3& light) {
    if (contributions == nullptr) {
      sum += scale * light;
    } else if (!contributions->empty() && contributions->back().pixel == pixel &&
               contributions->back().group == group) {
      contributions->back().light += scale * light;
    } else {
      contributions->push_back({pixel, group, scale * light});
    }
  }
};

void BiasCompensation::findRows(const View& view, vec2 jitter, int first, int last,
                                std::span<Pixel> pixels,
                                std::span<std::vector<Contribution>> byRow) const {
  tbb::parallel_for(first, last, [&](int y) {
    for (int x0 = 0; x0 < view.width; x0 += SeenPixels::kCount) {
      const auto [rays, hits] = SeenPixels(rays_, view, jitter, x0, y);
      for (int i = 0; i < std::min(SeenPixels::kCount, view.width - x0); ++i) {
        const auto index = static_cast<uint32_t>(y * view.width + x0 + i);
        pixels[index] = pixel(rays[i].direction, hits[i], index,
                              byRow.empty() ? nullptr : &byRow[static_cast<size_t>(y)]);
      }
    }
  });
}

BiasCompensation::Pixel BiasCompensation::pixel(const vec3& direction, const Hit& hit,
                                                uint32_t index,
                                                std::vector<Contribution>* contributions) const {
  if (!hit) return {};
  const Surface s = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
  const float side = glm::dot(direction, s.geometricNormal) < 0.0f ? 1.0f : -1.0f;
  const vec3 normal = side * s.geometricNormal;
  const Place from{s.position + rayEpsilon(s.position) * normal, normal,
                   scene_.objects[hit.object].leftOutBy};
  vec3 albedo = options_.white ? vec3(1.0f) : s.albedo;
  if (options_.speculars && !options_.white) {
    const Gloss gloss = glossAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
    albedo *= shared::diffuseShare(gloss.metallic, gloss.roughness, options_.leastRoughness,
                                   -side * glm::dot(s.normal, direction));
  }
  const bool isWhole =
      hit.object < options_.reflectsWithin.size() && options_.reflectsWithin[hit.object] != 0;
  const uint32_t whole = isWhole ? hit.object : kNoObject;
  Sink sink{contributions, index, 1.0f / static_cast<float>(options_.paths)};
  for (uint32_t path = 0; path < options_.paths; ++path) {
    PathSampler sampler(index, options_.sample * options_.paths + path, options_.seed);
    gather(from, whole, side * s.normal, sampler, sink);
  }
  return {sink.sum, albedo, s.position, normal};
}

// With cosine-distributed directions, the true light minus the clamped light is
//   mean of L(y) (1 − d²/d0²) over directions whose surface y is nearer than d0, times π,
// where L(y) is the emission of y, plus its reflection of the VPLs' clamped light and, after
// further bounces, of the compensation there.
void BiasCompensation::gather(Place from, uint32_t whole, const vec3& shadingNormal,
                              PathSampler& sampler, Sink& sink) const {
  const float reach = options_.clampDistance;
  vec3 throughput(1.0f), about = shadingNormal;
  for (int bounces = options_.bounces; bounces >= 0; --bounces) {
    const vec3 direction = Frame(about).toWorld(sampleCosineHemisphere(sampler.next2()));
    const vec2 u = sampler.next2();
    if (glm::dot(direction, from.normal) <= 0.0f) break;
    const Hit hit = rays_.intersect({from.position, 0.0f, direction, reach});
    if (!hit || (bounces == options_.bounces && hit.object == whole)) break;
    const Surface s = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
    const bool front = glm::dot(direction, s.geometricNormal) < 0.0f;
    throughput *= std::max(0.0f, 1.0f - hit.t * hit.t / (reach * reach));
    const RenderObject& there = scene_.objects[hit.object];
    const bool isExact = bounces == options_.bounces && hit.object < options_.exactLamps.size() &&
                         options_.exactLamps[hit.object] != 0;
    if (options_.emission && !isExact && !isLeftOut(from.leftOutBy, there.link))
      addEmission(hit, s, front, throughput, sink);
    if (bounces == 0) break;
    throughput *= s.albedo;
    if (throughput == vec3(0.0f)) break;
    // The geometric normal, as for VPLs, because this compensates their light.
    about = front ? s.geometricNormal : -s.geometricNormal;
    from = {s.position + rayEpsilon(s.position) * about, about, there.leftOutBy};
    addSuns(from, throughput * (1.0f / kPi), sink);
    addVpls(from, choices_[static_cast<size_t>(bounces - 1)], u, throughput * (1.0f / kPi), sink);
  }
}

void BiasCompensation::addEmission(const Hit& hit, const Surface& s, bool front,
                                   const vec3& throughput, Sink& sink) const {
  if (options_.emissions.empty()) {
    if ((front || s.emitsBothSides) && s.emission != vec3(0.0f))
      sink.add(0, throughput * s.emission);
    return;
  }
  const Emission& e = options_.emissions[hit.object];
  const auto material = static_cast<size_t>(scene_.objects[hit.object].material);
  if (!(e.reference > 0.0f) || !(front || scene_.materials[material].doubleSided)) return;
  sink.add(e.group, throughput * e.reference *
                        emissionShareAt(scene_, hit.object, hit.triangle, hit.u, hit.v));
}

void BiasCompensation::addSuns(const Place& at, const vec3& throughput, Sink& sink) const {
  for (const Sun& sun : suns_) {
    if (isLeftOut(at.leftOutBy, sun.link)) continue;
    const float cosine = glm::dot(at.normal, sun.towards);
    if (cosine > 0.0f && !rays_.occluded({at.position, 0.0f, sun.towards}))
      sink.add(sun.group, throughput * (cosine * sun.irradiance));
  }
}

// An estimate of the clamped irradiance of the other VPLs. Of the candidates, some get shadow rays,
// with a probability proportional to their unshadowed irradiance (Talbot et al., "Importance
// Resampling for Global Illumination", 2005).
void BiasCompensation::addVpls(const Place& at, const Choice& choice, vec2 u,
                               const vec3& throughput, Sink& sink) const {
  if (choice.entries.empty()) return;
  struct Candidate {
    const Choice::Entry* entry;
    float geometry;  // irradiance / intensity [1/m²]
    float upTo;      // cumulative brightness, including this VPL
  };
  std::array<Candidate, kVplsTried> tried;
  float total = 0.0f;
  for (int k = 0; k < kVplsTried; ++k) {
    const float below = (static_cast<float>(k) + u.x) / kVplsTried * choice.upTo.back();
    const Choice::Entry& chosen = choice.entries[choice.find(below)];
    const shared::Vpl& vpl = chosen.vpl;
    const float geometry =
        isLeftOut(at.leftOutBy, static_cast<uint32_t>(vpl.footprint.y))
            ? 0.0f
            : shared::vplGeometry(vpl, at.position, at.normal, at.normal, options_.clampDistance);
    total += geometry * chosen.brightness;
    tried[static_cast<size_t>(k)] = {&chosen, geometry, total};
  }
  if (!(total > 0.0f)) return;
  for (int k = 0; k < kRaysAPoint; ++k) {
    const float below = (static_cast<float>(k) + u.y) / kRaysAPoint * total;
    const auto it =
        std::upper_bound(tried.begin(), tried.end() - 1, below,
                         [](float value, const Candidate& c) { return value < c.upTo; });
    const float share = it->upTo - (it == tried.begin() ? 0.0f : (it - 1)->upTo);
    const Choice::Entry& e = *it->entry;
    if (!(share > 0.0f) || !sees(at, e.vpl)) continue;
    const float scale = it->geometry * e.weight * (total / share) / (kVplsTried * kRaysAPoint);
    sink.add(e.group, throughput * (scale * e.vpl.intensity));
  }
}

bool BiasCompensation::sees(const Place& at, const shared::Vpl& vpl) const {
  Ray ray{at.position, 0.0f, vec3(vpl.normal)};
  if (vpl.position.w != shared::kVplDirectional) {
    const vec3 way = vec3(vpl.position) - at.position;
    ray.tFar = glm::length(way);
    ray.direction = way / ray.tFar;
  }
  return !rays_.occluded(ray);
}

}  // namespace lamplighter
