#include "renderer/surface_light/surface_light.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/scene/light_linking.h"

namespace lamplighter {
namespace {

// Cosine of 2.2°: the sky so near a sun counts as part of it (SkyMap::suns()).
constexpr float kSunCosine = 0.99926f;

// Radiance of the sky without its suns, which are lights of their own.
vec3 skyWithoutSuns(const SkySampler& sky, const vec3& towards) {
  for (size_t i = 0; i < sky.sunCount(); ++i)
    if (glm::dot(sky.sun(i).towards, towards) > kSunCosine) return vec3(0.0f);
  return sky.radiance(towards);
}

// Where the objects that moved were and are.
std::vector<Bounds> boxesOf(const RenderScene& scene, const RenderSceneChanges& changes) {
  std::vector<Bounds> boxes = changes.movedBounds;
  for (const uint32_t o : changes.movedObjects) boxes.push_back(scene.objects[o].bounds);
  return boxes;
}

}  // namespace

bool SurfaceLight::update(const RenderScene& scene, const RenderSceneChanges& changes,
                          const RayCaster& rays, const SurfaceLightOptions& options) {
  counts_.rays = counts_.samplesTraced = counts_.factorsFound = counts_.masks = 0;
  const bool isFirst = links_.isEmpty();
  if (!isFirst && changes.none() && options == options_) return false;
  RenderSceneChanges all = changes;
  if (isFirst || options.seed != options_.seed || options.gatherRays != options_.gatherRays)
    all.rebuilt = true;
  options_ = options;
  lights_ = LightSet(scene, lights_);

  // 1. The elements, and what their rays see.
  const size_t perSample = sizeof(GatherLink) * static_cast<size_t>(options.gatherRays);
  const size_t most = std::max<size_t>(options.linkBytes / perSample, 1);
  const bool isNewMesh = mesh_.update(scene, all, {options.edge, most}) || all.rebuilt;
  const std::vector<Bounds> boxes = boxesOf(scene, all);
  std::vector<uint32_t> changed;
  // Changed materials may have other holes, so that rays pass elsewhere.
  const bool isNew = isNewMesh || all.materials;
  counts_.rays += cuts_.update(scene, rays, mesh_, isNew, all.movedObjects, boxes);
  if (isNew) {
    links_.restart(mesh_, options.gatherRays, options.seed);
    changed.resize(mesh_.samples());
    std::iota(changed.begin(), changed.end(), 0u);
    counts_.rays += links_.trace(scene, rays, mesh_, cuts_, changed);
  } else if (!all.movedObjects.empty()) {
    counts_.rays += links_.retrace(scene, rays, mesh_, cuts_, all.movedObjects, boxes, changed);
  }
  counts_.samplesTraced = changed.size();

  // 2. Their direct light.
  if (isNew) findAlbedo(scene);
  if (!changed.empty()) {
    state_.smoothing = LightSmoothing(scene, mesh_, links_);
    findMixed();
  }
  counts_.rays +=
      direct_.update({scene, rays, lights_, mesh_, state_.isMixed, options.seed, options.mask},
                     isNew, all.movedObjects, boxes);
  counts_.factorsFound = direct_.factors();
  counts_.masks = direct_.masked();
  state_.direct.resize(3 * mesh_.leaves());
  direct_.sum(lights_, state_.direct);
  state_.smoothing.fillCorners(mesh_, state_.direct);
  if (!changed.empty() || !(sky_ == scene.sky)) findSky(scene);

  // 3. Bounces.
  bounceLight(mesh_, links_, state_, options.bounces, bounced_);
  counts_.samples = mesh_.samples();
  counts_.leaves = mesh_.leaves();
  counts_.edge = mesh_.edge();
  counts_.bytes = mesh_.bytes() + links_.bytes() + direct_.bytes();
  return true;
}

void SurfaceLight::findAlbedo(const RenderScene& scene) {
  state_.albedo.resize(mesh_.leaves());
  tbb::parallel_for(size_t{0}, mesh_.leaves(), [&](size_t k) {
    const auto leaf = static_cast<uint32_t>(k);
    const auto places = mesh_.placesOfLeaf(leaf);
    vec3 sum(0.0f);
    for (const SurfacePlace& p : places) sum += albedoAt(scene, mesh_.objectOfLeaf(leaf), p);
    state_.albedo[k] = sum / static_cast<float>(places.size());
  });
}

void SurfaceLight::findMixed() {
  state_.isMixed.resize(mesh_.leaves());
  for (uint32_t leaf = 0; leaf < mesh_.leaves(); ++leaf) {
    const auto samples = mesh_.samplesOfLeaf(leaf);
    const auto buried =
        std::ranges::count_if(samples, [&](uint32_t s) { return state_.smoothing.isBuried(s); });
    state_.isMixed[leaf] = !mesh_.isCluster(leaf) && (cuts_.isCut(leaf) || buried > 0);
  }
}

// Rays that hit nothing see the sky.
void SurfaceLight::findSky(const RenderScene& scene) {
  sky_ = scene.sky;
  state_.sky.assign(mesh_.samples(), vec3(0.0f));
  const float share = kPi / static_cast<float>(links_.rays());
  tbb::parallel_for(size_t{0}, mesh_.samples(), [&](size_t k) {
    const auto sample = static_cast<uint32_t>(k);
    const uint32_t object = mesh_.objectOfSample(sample);
    if (scene.sky.isBlack() || isLeftOut(scene.objects[object].leftOutBy, scene.skyLink)) return;
    const auto links = links_.of(sample);
    const auto directions = links_.directionsOf(sample);
    if (std::ranges::find(links, GatherLink::kSky, &GatherLink::leaf) == links.end()) return;
    std::vector<SurfaceSpot> spots;
    for (const SurfacePlace& p : mesh_.placesOfSample(sample))
      spots.push_back(spotAt(scene, object, p));
    vec3 sum(0.0f);
    for (size_t i = 0; i < links.size(); ++i)
      if (links[i].leaf == GatherLink::kSky)
        sum +=
            skyWithoutSuns(lights_.sky(), gatherDirection(spots[i % spots.size()], directions[i]));
    state_.sky[k] = share * sum;
  });
  state_.smoothing.apply(state_.sky);
}

}  // namespace lamplighter
