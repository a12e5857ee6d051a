#include "renderer/sampling/direct_vpls.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/random.h"
#include "renderer/scene/ies/ies_profile.h"

namespace lamplighter {
namespace {

// Half-width of the square around the scene, slightly enlarged to include its edge.
constexpr float kWholeScene = 1.0001f;

}  // namespace

int directSamples(const VplCounts& counts) {
  const int total = std::max(counts.total, 0);
  const float share = std::clamp(counts.directShare, 0.0f, 1.0f);
  return counts.bounces <= 0 ? total
                             : static_cast<int>(std::lround(share * static_cast<float>(total)));
}

SampleShare directShareOf(const RenderScene& scene, const Emitter& e, const VplCounts& counts) {
  if ((counts.withoutSky && e.kind == EmitterKind::sky && e.skySun == 0) ||
      (counts.withoutSurfaces && e.kind == EmitterKind::surface))
    return {};
  const float weight = e.referenceFlux;
  if (e.kind == EmitterKind::sky && e.skySun > 0) return {weight, 1, true};
  if (e.kind != EmitterKind::punctual) return {weight, e.bothSides ? 2 : 1, false};
  const PunctualLight& light = scene.punctuals[e.punctual].light;
  if (light.profile) return {weight, static_cast<int>(light.profile->lobes.size()), true};
  return {weight, light.kind == PunctualKind::point ? 2 : 1, true};
}

void DirectVpls::add(const PathWalker::Source& source, int count, float scale,
                     std::vector<SceneVpl>& vpls) const {
  if (count <= 0) return;
  const Emitter& e = lights_.emitters()[static_cast<size_t>(source.emitter)];
  VplId id = source.id;
  const size_t first = vpls.size();
  const uint32_t begin = firstIndex(batch_, count), end = begin + static_cast<uint32_t>(count);
  switch (e.kind) {
    case EmitterKind::surface:
      for (id.index = begin; id.index < end; ++id.index) {
        const EmitterSample p =
            sampleEmitter(scene_, lights_, numbers_, source, id.index, SampleStreams::direct);
        if (p.flux == vec3(0.0f)) continue;  // a dark point; it would cost a shadow map
        const vec3 intensity = scale * p.flux / (kPi * static_cast<float>(count));
        vpls.push_back(numbers_.makeVpl(id, shared::kVplCosine, p.position, p.normal, intensity));
        vpls.back().area = p.area / static_cast<float>(count);
      }
      break;
    case EmitterKind::punctual:
      addPunctual(scene_.punctuals[e.punctual], id, vec3(scale * e.reference), vpls);
      break;
    case EmitterKind::sky:
      if (e.skySun > 0) {
        const SkyMap::Light sun = skySun(e, id);
        addSun(sun.towards, scale * sun.irradiance, id, vpls);
        break;
      }
      for (id.index = begin; id.index < end; ++id.index) {
        const SkyMap::Light light = lights_.referenceSky().sample(numbers_.point(
            id, id.index, SampleStreams::kDirectionDimension, SampleStreams::direct));
        const vec3 irradiance = scale / static_cast<float>(count) * light.irradiance;
        vpls.push_back(directional(id, light.towards, irradiance));
      }
      break;
  }
  for (size_t i = first; i < vpls.size(); ++i) vpls[i].vpl.footprint.y = static_cast<float>(e.link);
}

// Batches use different positions on the sun, so that their mean has soft shadows.
SkyMap::Light DirectVpls::skySun(const Emitter& e, const VplId& id) const {
  const size_t sun = e.skySun - 1;
  if (batch_ == 0) return lights_.referenceSky().sun(sun);
  return lights_.referenceSky().sun(
      sun, numbers_.point(id, batch_ - 1, SampleStreams::kPlaceDimension, SampleStreams::direct));
}

void DirectVpls::addPunctual(const RenderPunctual& p, VplId id, const vec3& intensity,
                             std::vector<SceneVpl>& vpls) const {
  if (p.light.profile) {
    id.index = 0;
    for (const SpotLobe& lobe : p.light.profile->lobes) {
      vpls.push_back(numbers_.makeVpl(id, shared::kVplUniform, p.position, p.axes * lobe.axis,
                                      lobe.intensity * intensity));
      vpls.back().isSample = false;
      vpls.back().vpl.normal.w = lobe.scale;
      vpls.back().vpl.tangent.w = lobe.offset;
      ++id.index;
    }
    return;
  }
  switch (p.light.kind) {
    case PunctualKind::point:
      for (id.index = 0; id.index < 2; ++id.index) {
        const vec3 axis(0.0f, id.index == 0 ? -1.0f : 1.0f, 0.0f);
        vpls.push_back(numbers_.makeVpl(id, shared::kVplUniform, p.position, axis, intensity));
        vpls.back().isSample = false;
      }
      break;
    case PunctualKind::spot: {
      vpls.push_back(numbers_.makeVpl(id, shared::kVplUniform, p.position, p.direction, intensity));
      vpls.back().isSample = false;
      const SpotCone cone(p.light);
      vpls.back().vpl.normal.w = cone.scale;
      vpls.back().vpl.tangent.w = cone.offset;
      break;
    }
    case PunctualKind::directional:
      addSun(-p.direction, intensity, id, vpls);
      break;
  }
}

// Adds one VPL for the whole sun, which is divided into shadow tiles later.
void DirectVpls::addSun(const vec3& towards, const vec3& irradiance, VplId id,
                        std::vector<SceneVpl>& vpls) const {
  id.index = 1;
  SceneVpl added = directional(id, towards, irradiance);
  added.isSample = false;
  added.vpl.tangent = vec4(numbers_.turnedTangent(id.set(), towards), added.vpl.tangent.w);
  vpls.push_back(added);
}

SceneVpl DirectVpls::directional(const VplId& id, const vec3& towards,
                                 const vec3& irradiance) const {
  SceneVpl made =
      numbers_.makeVpl(id, shared::kVplDirectional, lights_.sceneCentre(), towards, irradiance);
  made.vpl.normal.w = lights_.sceneRadius();
  made.vpl.tangent.w = kWholeScene * lights_.sceneRadius();
  return made;
}

}  // namespace lamplighter
