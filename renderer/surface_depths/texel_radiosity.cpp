#include "renderer/surface_depths/texel_radiosity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"
#include "renderer/texels/texel_rays.h"

namespace lamplighter {
namespace {

// Expected memory of a texel: for each pixel of its depth map a segment of three bytes per eight
// texels, and this number of links.
constexpr size_t kSegmentBytes = 3, kTexelsASegment = 8, kLinksATexel = 500;
// Number of texels whose links are computed at a time; work per texel in addition to its tests
// [rays]; number of reused tests that take as long as a ray.
constexpr size_t kLinkedAtATime = 64;
constexpr uint64_t kRaysALinkedTexel = 64, kKnownARay = 8;

}  // namespace

float texelSideOf(const RenderScene& scene, const TexelRadiosityOptions& options) {
  const size_t bytes =
      options.map.pixels() * kSegmentBytes / kTexelsASegment + kLinksATexel * sizeof(TexelLink);
  return texelSideFor(scene, options.texel, options.memory / bytes);
}

// Rebuilds the texels if surfaces have moved. While surfaces move, the old texels are kept.
void TexelRadiosity::takeGeometry(const RenderScene& scene, Services& services,
                                  const RenderSceneChanges& changes) {
  const SceneTexels::Update update = ground_.take(
      scene, services, changes, [&] { return texelSideOf(scene, options_); }, options_.order);
  counts_.texel = ground_.side();
  counts_.rays += ground_.rays();
  const TexelSet& texels = ground_.set();
  if (update.change == SceneTexels::Change::found) {
    const TexelTree before = std::exchange(tree_, TexelTree(texels));
    if (changes.rebuilt) irradiance_.clear();
    if (!irradiance_.empty()) irradiance_ = update.moves.carried(irradiance_);
    if (update.isAnew || usesDepths()) {
      depths_.restart(scene, texels, options_.map);
      hasLookedOnDisk_ = false;
      depthKey_.reset();
      links_.restart(texels, options_.linkError);
      light_.restart();
    } else {
      if (links_.isDone()) {
        placesOfLinks_ = update.before;
        movedSinceLinks_.clear();
      }
      movedSinceLinks_.insert(update.moved.begin(), update.moved.end());
      links_.restart(before, texels, tree_,
                     placesOfLinks_.movesTo(scene, texels, movedSinceLinks_));
      light_.outdate(update.moves, true);
    }
  } else if (update.change == SceneTexels::Change::lamps) {
    light_.outdate(update.moves, false);
    movedSinceLinks_.insert(update.moved.begin(), update.moved.end());
  }
  if (update.change == SceneTexels::Change::found || changes.materials || changes.objects)
    albedo_ = albedoOf(scene, texels);
}

void TexelRadiosity::findLinks(const RenderScene& scene, const RayCaster& rays, uint64_t most) {
  const Visibility byRays = [&](uint32_t t, const vec3& point) {
    return seesByRay(scene, rays, ground_.set()[t], point);
  };
  const Visibility byDepths = [&](uint32_t t, const vec3& point) {
    return depths_.sees(ground_.set()[t], t, point);
  };
  for (uint64_t spent = 0; !links_.isDone() && spent < most;) {
    links_.goOn(ground_.set(), tree_, usesDepths() ? byDepths : byRays, kLinkedAtATime);
    spent += links_.tested() + links_.known() / kKnownARay + kRaysALinkedTexel * kLinkedAtATime;
    counts_.links += links_.tested();
  }
}

void TexelRadiosity::update(const RenderScene& scene, Services& services,
                            const TexelRadiosityOptions& options, uint64_t mostRays) {
  counts_.rays = counts_.links = 0;
  const RenderSceneChanges changes = std::exchange(unseen_, {});
  TexelRadiosityOptions other = options;
  other.bounces = options_.bounces;
  if (other != options_) ground_.restart();
  const bool isSame = options == options_ && changes.none() && ground_.version() > 0;
  if (isSame && isDone()) return;
  options_ = options;
  const RayCaster& rays = services.rays();
  if (!isSame) {
    lights_ = LightSet(scene, lights_);
    isLit_ = false;
  }
  takeGeometry(scene, services, changes);
  counts_.rays += light_.update(scene, rays, lights_, ground_.set(), changes.movedObjects,
                                options.seed, mostRays / 2);
  isLit_ = isLit_ && !light_.changed();
  if (!ground_.isStale() && usesDepths()) findDepths(scene, services, mostRays);
  if (!ground_.isStale() && (!usesDepths() || depths_.isDone())) {
    findSky(scene, rays, mostRays);
    findLinks(scene, rays, mostRays - std::min(mostRays, counts_.rays));
  }
  if (links_.isDone() && !isLit_) bounce();
  counts_.bytes = depths_.bytes() + links_.bytes() + light_.bytes();
}

// From disk or by rays.
void TexelRadiosity::findDepths(const RenderScene& scene, Services& services, uint64_t mostRays) {
  const DepthCache files(services.cacheFolder());
  if (!hasLookedOnDisk_ && !services.cacheFolder().empty()) {
    depthKey_ = DepthCache::keyOf(scene, ground_.set(), options_.map);
    // Depths from disk need not be saved.
    if (depthKey_ && files.load(*depthKey_, depths_)) depthKey_.reset();
  }
  hasLookedOnDisk_ = true;
  if (!depths_.isDone())
    counts_.rays += depths_.goOn(scene, services.rays(), ground_.set(),
                                 mostRays - std::min(mostRays, counts_.rays));
  if (!depths_.isDone()) return;
  if (depthKey_) files.save(*std::exchange(depthKey_, std::nullopt), depths_);
}

void TexelRadiosity::findSky(const RenderScene& scene, const RayCaster& rays, uint64_t most) {
  const auto byRays = [&](uint32_t t, const vec3& direction) {
    return !blocksBouncedLight(scene, rays, {ground_.set()[t].spot.rayOrigin(), 0.0f, direction});
  };
  const auto byDepths = [&](uint32_t t, const vec3& direction) {
    return depths_.isOpen(t, depths_.layout().pixelOf(direction));
  };
  const uint64_t tested = usesDepths()
                              ? light_.updateSky(scene, lights_, ground_.set(), byDepths, most)
                              : light_.updateSky(scene, lights_, ground_.set(), byRays, most);
  if (!usesDepths()) counts_.rays += tested;
  isLit_ = isLit_ && !light_.changed();
}

// Jacobi iterations: radiosity is averaged up the tree, then gathered along the links.
void TexelRadiosity::bounce() {
  std::vector<vec3> direct(ground_.set().size()), byNode;
  light_.sum(lights_, direct);
  irradiance_.assign(ground_.set().size(), vec3(0.0f));
  radiosity_.assign(ground_.set().size(), vec3(0.0f));
  for (int b = 0; b < options_.bounces; ++b) {
    for (size_t t = 0; t < radiosity_.size(); ++t)
      radiosity_[t] = albedo_[t] * (direct[t] + irradiance_[t]);
    tree_.pull(radiosity_, byNode);
    links_.gather(byNode, irradiance_);
  }
  isLit_ = light_.isDone();
  ++version_;
}

std::optional<std::vector<TexelSender>> TexelRadiosity::sendersTo(const RenderScene& scene,
                                                                  const RayCaster& rays,
                                                                  uint32_t object,
                                                                  uint32_t triangle, bool isBack,
                                                                  const vec3& position) const {
  if (!unseen_.none() || !links_.isDone() || irradiance_.empty() ||
      radiosity_.size() != ground_.set().size())
    return std::nullopt;
  return lamplighter::sendersTo(blendAt(scene, rays, object, triangle, isBack, position),
                                ground_.set(), tree_, links_, radiosity_);
}

bool TexelRadiosity::isDone() const {
  return ground_.isCurrent() && isLit_ && links_.isDone() && (!usesDepths() || depths_.isDone()) &&
         unseen_.none();
}

float TexelRadiosity::progress() const {
  return usesDepths() ? 0.5f * (depths_.progress() + links_.progress()) : links_.progress();
}

}  // namespace lamplighter
