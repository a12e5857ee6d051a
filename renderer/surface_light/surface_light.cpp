#include "renderer/surface_light/surface_light.h"

#include <algorithm>
#include <numeric>

#include <tbb/parallel_for.h>

#include "renderer/scene/light_linking.h"

namespace lamplighter {
namespace {

// If there are more than kManyLinks links in all, one in kLiveShare is used while anything except
// brightness changes.
constexpr int kLiveShare = 4;
constexpr size_t kManyLinks = size_t{1} << 22;

// If memory is limited, samples have at least this number of rays, and only then elements become
// larger: in levels with many samples the mean of neighbours is as smooth.
constexpr int kFewRays = 32;

// The mesh represents the light fully if the mean hit distance of a sample is at least the larger
// number of element edges, and not at all below the smaller number.
constexpr float kFullReach = 4.0f, kLeastReach = 1.0f;

size_t mostSamples(const SurfaceLightOptions& options) {
  const auto rays = static_cast<size_t>(std::min(kFewRays, options.gatherRays));
  return std::max<size_t>(options.linkBytes / (sizeof(GatherLink) * rays), 1);
}

// The requested number of rays, halved until the links fit into memory.
int gatherRays(const SurfaceLightOptions& options, size_t samples) {
  int rays = options.gatherRays;
  while (rays > kFewRays &&
         samples * sizeof(GatherLink) * static_cast<size_t>(rays) > options.linkBytes)
    rays = std::max(kFewRays, rays / 2);
  return rays;
}

// Bounds of moved objects, before and after.
std::vector<Bounds> boxesOf(const RenderScene& scene, const RenderSceneChanges& changes) {
  std::vector<Bounds> boxes = changes.movedBounds;
  for (const uint32_t o : changes.movedObjects) boxes.push_back(scene.objects[o].bounds);
  return boxes;
}

}  // namespace

bool SurfaceLight::update(const RenderScene& scene, const RenderSceneChanges& changes,
                          const RayCaster& rays, const SurfaceLightOptions& options,
                          uint64_t mostRays) {
  counts_.rays = counts_.samplesTraced = counts_.factorsFound = counts_.masks = 0;
  keptMesh_ = true;
  moved_.clear();
  boxes_.clear();
  hasOtherElements_ = false;
  const bool isSame = options == options_ && changes.none() && isStarted_;
  if (isSame && isDone_) return false;
  const bool isFirst = !isStarted_ || changes.rebuilt || options.seed != options_.seed ||
                       options.projection != options_.projection;
  isStarted_ = true;
  const bool hasOtherOptions = !(options == options_);
  options_ = options;
  lights_ = LightSet(scene, lights_);

  // 1. The elements and their gather rays.
  const SurfaceMeshChange mesh = mesh_.update(scene, changes, {options.edge, mostSamples(options)});
  const int raysOfSample = gatherRays(options, mesh_.usedSamples());
  const bool isNew = mesh.isNew || isFirst || raysOfSample != links_.rays();
  moved_ = changes.movedObjects;
  moved_.insert(moved_.end(), mesh.objects.begin(), mesh.objects.end());
  if (!isNew) boxes_ = boxesOf(scene, changes);
  if (!isNew) boxes_.insert(boxes_.end(), mesh.boxes.begin(), mesh.boxes.end());
  hasOtherElements_ = isNew || !mesh.objects.empty();
  keptMesh_ = !isNew && moved_.empty() && !changes.materials;
  if (!isSame) counts_.rays += cuts_.update(scene, rays, mesh_, isNew, moved_, boxes_);
  if (isNew) {
    links_.restart(mesh_, raysOfSample, options.seed, options.projection);
  } else if (!moved_.empty()) {
    if (!mesh.objects.empty()) links_.renew(mesh_, mesh.objects);
    links_.outdate(scene, rays, mesh_, cuts_, moved_, boxes_);
  }
  const bool wasCurrent = links_.isCurrent() && direct_.isDone();
  const int stage = links_.stage();
  std::vector<uint32_t> traced;
  const uint64_t gathered = links_.trace(scene, rays, mesh_, cuts_, mostRays, traced);
  counts_.rays += gathered;
  counts_.samplesTraced = traced.size();
  findSky(scene, traced);
  if (isNew) isUnsmoothed_.clear();
  isUnsmoothed_.resize(mesh_.samples(), 0);
  for (const uint32_t s : traced) isUnsmoothed_[s] = 1;
  if (isNew || changes.materials || !mesh.objects.empty()) findAlbedo(scene);
  const bool isLive = isNew || hasOtherOptions || !changes.none();
  if (isLive || links_.isDone() || links_.stage() != stage || !wasCurrent) smooth(scene, isNew);

  // 2. Their direct light.
  const uint64_t left = mostRays - std::min(mostRays, gathered);
  counts_.rays +=
      direct_.update({scene, rays, lights_, mesh_, state_.isMixed, options.seed, options.mask},
                     isNew, moved_, boxes_, std::max(left, mostRays / 2));
  counts_.factorsFound = direct_.factors();
  counts_.masks = direct_.masked();

  // 3. Bounces: not in every frame in which a picture at rest gets more rays.
  const bool isCurrent = links_.isCurrent() && direct_.isDone();
  const bool isReady = links_.isDone() && direct_.isDone();
  isDone_ = false;
  if (!isLive && !isReady && links_.stage() == stage && !(isCurrent && !wasCurrent)) return false;
  const bool isLinear = changes.onlyBrightness() && !isNew;
  const bool hasTime = mostRays == kAllRays || !isLive || isLinear ||
                       mesh_.usedSamples() * static_cast<size_t>(links_.rays()) <= kManyLinks;
  findLight(options.bounces,
            hasTime ? links_.rays() : (links_.rays() + kLiveShare - 1) / kLiveShare);
  isDone_ = isReady && hasTime;
  counts_.samples = mesh_.usedSamples();
  counts_.leaves = mesh_.usedLeaves();
  counts_.edge = mesh_.edge();
  counts_.bytes = mesh_.bytes() + links_.bytes() + direct_.bytes() + state_.smoothing.bytes();
  return true;
}

// Uses the rays that were traced since the last call.
void SurfaceLight::smooth(const RenderScene& scene, bool isNewMesh) {
  std::vector<uint32_t> changed;
  for (uint32_t s = 0; s < isUnsmoothed_.size(); ++s)
    if (isUnsmoothed_[s] && mesh_.objectOfSample(s) != SurfaceMesh::kUnused) changed.push_back(s);
  std::ranges::fill(isUnsmoothed_, uint8_t{0});
  if (!isNewMesh && changed.empty() && state_.isMixed.size() == mesh_.leaves()) return;
  state_.smoothing.update(scene, mesh_, links_, changed, isNewMesh);
  findMixed();
}

void SurfaceLight::findLight(int bounces, int most) {
  state_.direct.resize(3 * mesh_.leaves());
  direct_.sum(lights_, state_.direct);
  state_.smoothing.fillCorners(mesh_, state_.direct);
  skyBrightness_ = vec3(0.0f);
  for (const Emitter& e : lights_.emitters())
    if (e.kind == EmitterKind::sky && e.skySun == 0) skyBrightness_ = e.brightness();
  state_.sky.resize(mesh_.samples());
  for (size_t s = 0; s < state_.sky.size(); ++s) state_.sky[s] = skyBrightness_ * sky_[s];
  if (skyBrightness_ != vec3(0.0f)) state_.smoothing.apply(mesh_, state_.sky);
  bounceLight(mesh_, links_, state_, bounces, most, options_.part, bounced_, reflected_);
  gathered_ = static_cast<size_t>(most);
}

std::map<uint32_t, double> SurfaceLight::sharesOf(uint32_t object, uint32_t value) const {
  if (value < mesh_.samples()) return state_.smoothing.sharesOf(mesh_, value);
  const SurfaceMesh::Part& part = mesh_.part(object);
  const SurfaceShape::Blend& blend = part.shape->blends[value - mesh_.samples() - part.firstBlend];
  std::map<uint32_t, double> out;
  for (size_t k = 0; k < blend.weights.size(); ++k) {
    if (!(blend.weights[k] > 0.0f)) continue;
    for (const auto& [sample, share] :
         state_.smoothing.sharesOf(mesh_, part.firstSample + blend.samples[k]))
      out[sample] += static_cast<double>(blend.weights[k]) * share;
  }
  return out;
}

float SurfaceLight::trustAt(const MeshPoint& point) const {
  if (state_.isMixed.empty() || state_.isMixed[point.leaf] || mesh_.isCluster(point.leaf))
    return 0.0f;
  float trust = 0.0f;
  const auto samples = mesh_.samplesOfLeaf(point.leaf);
  for (size_t c = 0; c < 3; ++c) {
    const float ratio = state_.smoothing.reachOf(samples[c]) / mesh_.edge();
    trust += point.weights[static_cast<int>(c)] *
             std::clamp((ratio - kLeastReach) / (kFullReach - kLeastReach), 0.0f, 1.0f);
  }
  return trust;
}

void SurfaceLight::findAlbedo(const RenderScene& scene) {
  state_.albedo.resize(mesh_.leaves());
  tbb::parallel_for(size_t{0}, mesh_.leaves(), [&](size_t k) {
    const auto leaf = static_cast<uint32_t>(k);
    if (mesh_.objectOfLeaf(leaf) == SurfaceMesh::kUnused) return;
    const auto places = mesh_.placesOfLeaf(leaf);
    vec3 sum(0.0f);
    for (const SurfacePlace& p : places) sum += albedoAt(scene, mesh_.objectOfLeaf(leaf), p);
    state_.albedo[k] = sum / static_cast<float>(places.size());
  });
}

void SurfaceLight::findMixed() {
  state_.isMixed.assign(mesh_.leaves(), 0);
  for (uint32_t leaf = 0; leaf < mesh_.leaves(); ++leaf) {
    if (mesh_.objectOfLeaf(leaf) == SurfaceMesh::kUnused) continue;
    const auto samples = mesh_.samplesOfLeaf(leaf);
    const auto buried =
        std::ranges::count_if(samples, [&](uint32_t s) { return state_.smoothing.isBuried(s); });
    state_.isMixed[leaf] = !mesh_.isCluster(leaf) && (cuts_.isCut(leaf) || buried > 0);
  }
}

// Sky light along the rays of these samples that hit nothing; of all samples if the sky changed.
void SurfaceLight::findSky(const RenderScene& scene, std::span<const uint32_t> samples) {
  sky_.resize(mesh_.samples(), vec3(0.0f));
  std::vector<uint32_t> all;
  const Sky sky = lights_.unitSky();
  if (!(seenSky_ == sky)) {
    seenSky_ = sky;
    ++skyVersion_;
    all.resize(mesh_.samples());
    std::iota(all.begin(), all.end(), 0u);
    samples = all;
  }
  tbb::parallel_for(size_t{0}, samples.size(), [&](size_t k) {
    const uint32_t sample = samples[k];
    const uint32_t object = mesh_.objectOfSample(sample);
    sky_[sample] = vec3(0.0f);
    if (object == SurfaceMesh::kUnused) return;
    std::vector<SurfaceSpot> spots;
    for (const SurfacePlace& p : mesh_.placesOfSample(sample))
      spots.push_back(spotAt(scene, object, p));
    sky_[sample] = skyAlong(scene, object, spots, links_.directionsOf(sample), links_.of(sample));
  });
}

vec3 SurfaceLight::skyTowards(const vec3& direction) const {
  if (seenSky_.isBlack()) return vec3(0.0f);
  return lights_.referenceSky().withoutSuns(direction) / lights_.skyReference();
}

vec3 SurfaceLight::skyAlong(const RenderScene& scene, uint32_t object,
                            std::span<const SurfaceSpot> spots, std::span<const vec3> directions,
                            std::span<const GatherLink> links) const {
  if (seenSky_.isBlack() || isLeftOut(scene.objects[object].leftOutBy, scene.skyLink))
    return vec3(0.0f);
  vec3 sum(0.0f);
  for (size_t i = 0; i < links.size(); ++i)
    if (links[i].leaf == GatherLink::kSky)
      sum += lights_.referenceSky().withoutSuns(
          gatherDirection(spots[i % spots.size()], directions[i]));
  return kPi / static_cast<float>(links.size()) * sum / lights_.skyReference();
}

}  // namespace lamplighter
