#include "renderer/sampling/vpl_set.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "renderer/sampling/low_discrepancy.h"
#include "renderer/sampling/parallel_start.h"
#include "renderer/sampling/random.h"
#include "renderer/sampling/sun_squares.h"
#include "renderer/sampling/vpl_counts.h"
#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// Paths that may be begun for each VPL wanted: in an open scene most escape.
constexpr uint32_t kPathsPerVpl = 16;
// Dimension pairs of a path's points: where and whereto it leaves; those of bounce b > 0 follow.
constexpr uint32_t kPlaceDimension = 0, kDirectionDimension = 1;
// And through which part of the level parallel light goes; behind those of all bounces.
constexpr uint32_t kChoiceDimension = 100;
// A square around the scene, with what lies on its very edge.
constexpr float kWholeScene = 1.0001f;
// Squares that one sun may take: an eighth of the level's width each way if it is even.
constexpr int kMostSquares = 64;
constexpr uint32_t kDirectSet = 0x0d, kIndirectSet = 0x1d, kBatchSet = 0x2d;

bool isBlack(const vec3& c) { return !(c.r > 0.0f || c.g > 0.0f || c.b > 0.0f); }

// A path on its way: from where, whereto, and the flux it carries if it were the only one.
struct Departure {
  vec3 origin, direction;
  vec3 flux;
};

class Generator {
 public:
  Generator(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
            const VplCounts& counts)
      : scene_(scene),
        rays_(rays),
        lights_(lights),
        counts_(counts),
        seed_(counts.batch == 0 ? counts.seed : hash4(counts.seed, 0, 0, kBatchSet)),
        turn_(counts.batch == 0 ? 0 : hash4(counts.seed, counts.batch, 0, kBatchSet)),
        parallelStart_(scene, lights.sceneCentre(), lights.sceneRadius()) {}

  VplSet run() {
    const std::vector<Emitter>& emitters = lights_.emitters();
    const int total = std::max(counts_.total, 0);
    const float share = std::clamp(counts_.directShare, 0.0f, 1.0f);
    const int direct = counts_.bounces <= 0
                           ? total
                           : static_cast<int>(std::lround(share * static_cast<float>(total)));
    std::vector<SampleShare> directShares, indirectShares;
    for (const Emitter& e : emitters) {
      directShares.push_back(shareOf(e));
      indirectShares.push_back({luminance(e.flux), 1, false});
    }
    const SampleCounts directCounts = shareSamples(directShares, direct);
    const SampleCounts indirectCounts =
        shareSamples(indirectShares, walksPaths() ? counts_.paths : total - direct);
    std::map<NodeId, uint32_t> emittersOfNode;
    for (size_t i = 0; i < emitters.size(); ++i) {
      emitter_ = static_cast<int>(i);
      id_ = {emitters[i].node, emittersOfNode[emitters[i].node]++, 0, 0};
      addDirect(emitters[i], directCounts.counts[i], directCounts.scale);
      addIndirect(emitters[i], indirectCounts.counts[i], indirectCounts.scale);
    }
    return std::move(result_);
  }

 private:
  // The samples that an emitter cannot do without: a two-sided one takes turns, a point light is
  // two hemispheres.
  SampleShare shareOf(const Emitter& e) const {
    const float weight = luminance(e.flux);
    if (e.kind != EmitterKind::punctual) return {weight, e.bothSides ? 2 : 1, false};
    const PunctualKind kind = scene_.punctuals[e.punctual].light.kind;
    return {weight, kind == PunctualKind::point ? 2 : 1, kind != PunctualKind::directional};
  }

  // Two coordinates of the point `index` of the current emitter's sequence, stable in index.
  vec2 point(uint32_t index, uint32_t dimension, uint32_t set) const {
    const uint32_t scramble = hash4(id_.light, id_.emitter, seed_, set);
    // Padded dimensions must not walk in step, so all but the first are shuffled.
    return dimension == kPlaceDimension ? sobol2Ordered(index, scramble)
                                        : sobol2(index, hash4(scramble, dimension, 0, 0));
  }

  // Where a batch goes on in a sequence of which each takes `count` points.
  uint32_t firstIndex(int count) const {
    return counts_.batch == 0 ? 0 : (counts_.batch - 1) * static_cast<uint32_t>(count);
  }

  // Turned about the normal by chance, so that the texel grids of many maps do not line up on the
  // walls of a room.
  vec3 turnedTangent(const vec3& normal) const {
    const Frame frame(normal);
    const float angle =
        2.0f * kPi * toUnitFloat(hash4(id_.light, id_.emitter, id_.bounce, id_.index ^ turn_));
    return glm::normalize(std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent);
  }

  SceneVpl& add(float kind, const vec3& position, const vec3& normal, const vec3& intensity) {
    SceneVpl& added = result_.vpls.emplace_back();
    added.vpl = {vec4(position, kind), vec4(normal, 0.0f), vec4(turnedTangent(normal), 1.0f),
                 vec4(intensity, -1.0f)};
    added.id = id_;
    return added;
  }

  void addDirect(const Emitter& e, int count, float scale) {
    if (count <= 0) return;
    id_.bounce = 0;
    const uint32_t begin = firstIndex(count), end = begin + static_cast<uint32_t>(count);
    switch (e.kind) {
      case EmitterKind::surface:
        for (id_.index = begin; id_.index < end; ++id_.index) {
          const SurfacePoint p = surfacePoint(e, id_.index, kDirectSet);
          const vec3 intensity = scale * p.flux / (kPi * static_cast<float>(count));
          add(shared::kVplCosine, p.position, p.normal, intensity);
        }
        break;
      case EmitterKind::punctual:
        addPunctual(scene_.punctuals[e.punctual], count, scale);
        break;
      case EmitterKind::sky:
        if (e.skySun > 0) {
          const SkyMap::Light sun = skySun(e);
          addSun(sun.towards, scale * sun.irradiance, std::min(count, kMostSquares));
          break;
        }
        for (id_.index = begin; id_.index < end; ++id_.index) {
          const SkyMap::Light light =
              lights_.sky().sample(point(id_.index, kDirectionDimension, kDirectSet));
          addDirectional(light.towards, scale / static_cast<float>(count) * light.irradiance);
        }
        break;
    }
  }

  void addPunctual(const RenderPunctual& p, int count, float scale) {
    const vec3 intensity = scale * p.light.intensity;
    switch (p.light.kind) {
      case PunctualKind::point:
        for (id_.index = 0; id_.index < 2; ++id_.index) {
          const vec3 axis(0.0f, id_.index == 0 ? -1.0f : 1.0f, 0.0f);
          add(shared::kVplUniform, p.position, axis, intensity).isSample = false;
        }
        break;
      case PunctualKind::spot: {
        id_.index = 0;
        SceneVpl& added = add(shared::kVplUniform, p.position, p.direction, intensity);
        added.isSample = false;
        const Cone cone(p.light);
        added.vpl.normal.w = cone.scale;
        added.vpl.tangent.w = cone.offset;
        break;
      }
      case PunctualKind::directional:
        addSun(-p.direction, intensity, std::min(count, kMostSquares));
        break;
    }
  }

  void addSun(const vec3& towards, const vec3& irradiance, int count) {
    id_.index = 0;
    const vec3 tangent = turnedTangent(towards);  // the same for all its squares
    const mat3 axes(tangent, glm::cross(towards, tangent), towards);
    const vec3 middle = lights_.sceneCentre();
    const float whole = kWholeScene * lights_.sceneRadius();
    for (const SunSquare& square : sunSquares(scene_, axes, middle, whole, count)) {
      id_.index = square.code;
      SceneVpl& added = addDirectional(towards, irradiance);
      added.isSample = false;
      added.vpl.position += vec4(axes * vec3(square.centre, 0.0f), 0.0f);
      added.vpl.tangent = vec4(tangent, square.side);
    }
  }

  // Batches shine from places all over it, so that their mean has soft shadows.
  SkyMap::Light skySun(const Emitter& e) const {
    const size_t sun = e.skySun - 1;
    if (counts_.batch == 0) return lights_.sky().sun(sun);
    return lights_.sky().sun(sun, point(counts_.batch - 1, kPlaceDimension, kDirectSet));
  }

  SceneVpl& addDirectional(const vec3& towards, const vec3& irradiance) {
    SceneVpl& added = add(shared::kVplDirectional, lights_.sceneCentre(), towards, irradiance);
    added.vpl.normal.w = lights_.sceneRadius();
    added.vpl.tangent.w = kWholeScene * lights_.sceneRadius();
    return added;
  }

  // Angular attenuation of a spot as KHR_lights_punctual recommends: clamp(cos·scale + offset)².
  struct Cone {
    explicit Cone(const PunctualLight& light)
        : scale(1.0f / std::max(0.001f, std::cos(light.innerCone) - std::cos(light.outerCone))),
          offset(-std::cos(light.outerCone) * scale) {}
    float at(float cosine) const {
      const float a = std::clamp(cosine * scale + offset, 0.0f, 1.0f);
      return a * a;
    }
    float scale, offset;
  };

  struct SurfacePoint {
    vec3 position, normal;
    vec3 flux;  // of the whole emitter, were it as bright as here
  };
  SurfacePoint surfacePoint(const Emitter& e, uint32_t index, uint32_t set) const {
    const uint32_t parts = e.bothSides ? 2 : 1;
    const EmitterPoint at =
        lights_.samplePoint(scene_, emitter_, point(index / parts, kPlaceDimension, set));
    const float side = index % parts == 0 ? 1.0f : -1.0f;
    SurfacePoint p;
    p.normal = side * at.normal;
    p.position = at.position + rayEpsilon(at.position) * p.normal;
    p.flux = kPi * e.area * static_cast<float>(parts) * at.radiance;
    return p;
  }

  Departure depart(const Emitter& e, uint32_t path) const {
    const vec2 u = point(path, kDirectionDimension, kIndirectSet);
    switch (e.kind) {
      case EmitterKind::surface: {
        const SurfacePoint p = surfacePoint(e, path, kIndirectSet);
        return {p.position, Frame(p.normal).toWorld(sampleCosineHemisphere(u)), p.flux};
      }
      case EmitterKind::punctual:
        return departPunctual(scene_.punctuals[e.punctual], path, u);
      case EmitterKind::sky:
        break;
    }
    const SkyMap::Light light =
        e.skySun > 0 ? lights_.sky().sun(e.skySun - 1, u) : lights_.sky().sample(u);
    return departParallel(light.towards, light.irradiance, path);
  }

  Departure departPunctual(const RenderPunctual& p, uint32_t path, vec2 u) const {
    if (p.light.kind == PunctualKind::directional) {
      return departParallel(-p.direction, p.light.intensity, path);
    }
    if (p.light.kind == PunctualKind::point) {
      return {p.position, sampleSphere(u), 4.0f * kPi * p.light.intensity};
    }
    // Uniform over the cap of the outer cone.
    const float cap = 1.0f - std::cos(p.light.outerCone);
    const float z = 1.0f - u.x * cap;
    const float r = std::sqrt(std::max(0.0f, 1.0f - z * z));
    const float phi = 2.0f * kPi * u.y;
    const vec3 local(r * std::cos(phi), r * std::sin(phi), z);
    const float attenuation = Cone(p.light).at(z);
    return {p.position, Frame(p.direction).toWorld(local),
            2.0f * kPi * cap * attenuation * p.light.intensity};
  }

  // From the edge of the scene, towards where the level has its detail: flux = E / density.
  Departure departParallel(const vec3& towards, const vec3& irradiance, uint32_t path) const {
    const ParallelStart::Point p =
        parallelStart_.sample(towards, point(path, kPlaceDimension, kIndirectSet),
                              point(path, kChoiceDimension, kIndirectSet).x);
    return {p.position + lights_.sceneRadius() * towards, -towards, irradiance / p.pdf};
  }

  bool walksPaths() const { return counts_.paths > 0; }

  // `count` paths, or paths until there are `count` VPLs. One that would leave too many is not
  // begun, so that its last bounces are not cut off: that would favour the first ones.
  void addIndirect(const Emitter& e, int count, float scale) {
    if (count <= 0 || counts_.bounces <= 0) return;
    const size_t first = result_.vpls.size();
    const uint32_t cap = (walksPaths() ? 1 : kPathsPerVpl) * static_cast<uint32_t>(count);
    const size_t most = walksPaths() ? std::numeric_limits<size_t>::max() : count;
    const uint32_t begin = firstIndex(count);
    uint32_t paths = 0;
    while (paths < cap && result_.vpls.size() - first < most) {
      id_.index = begin + paths;
      const size_t before = result_.vpls.size();
      walk(depart(e, id_.index));
      if (result_.vpls.size() - first > most && before > first) {
        result_.vpls.resize(before);
        break;
      }
      ++paths;
    }
    // Only a path longer than all VPLs together is cut.
    if (result_.vpls.size() - first > most) result_.vpls.resize(first + most);
    result_.paths += static_cast<int>(paths);
    const float share = scale / static_cast<float>(std::max(paths, 1u));
    for (size_t i = first; i < result_.vpls.size(); ++i) {
      vec4& intensity = result_.vpls[i].vpl.intensity;
      intensity = vec4(share * vec3(intensity), intensity.w);
    }
  }

  void walk(const Departure& departure) {
    Ray ray{departure.origin, 0.0f, departure.direction};
    vec3 flux = departure.flux;
    for (id_.bounce = 1; id_.bounce <= static_cast<uint32_t>(counts_.bounces); ++id_.bounce) {
      const Hit hit = rays_.intersect(ray);
      ++result_.rays;
      if (!hit) return;
      const Surface s = surfaceAt(scene_, hit.object, hit.triangle, hit.u, hit.v);
      flux *= s.albedo;
      if (isBlack(flux)) return;
      const vec3 normal = glm::dot(s.geometricNormal, ray.direction) < 0.0f ? s.geometricNormal
                                                                            : -s.geometricNormal;
      const vec3 origin = s.position + rayEpsilon(s.position) * normal;
      add(shared::kVplCosine, origin, normal, flux / kPi);
      const vec2 u = point(id_.index, kDirectionDimension + id_.bounce, kIndirectSet);
      ray = {origin, 0.0f, Frame(normal).toWorld(sampleCosineHemisphere(u))};
    }
  }

  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  const VplCounts& counts_;
  uint32_t seed_, turn_;
  ParallelStart parallelStart_;
  VplSet result_;
  int emitter_ = 0;
  VplId id_;
};

}  // namespace

VplSet generateVpls(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                    const VplCounts& counts) {
  return Generator(scene, rays, lights, counts).run();
}

}  // namespace lamplighter
