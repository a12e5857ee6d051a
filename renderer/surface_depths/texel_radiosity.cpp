#include "renderer/surface_depths/texel_radiosity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"
#include "renderer/surface_depths/texel_sight.h"

namespace lamplighter {
namespace {

// What memory a texel is expected to take: of each pixel a segment of three bytes for eight texels,
// and so many links.
constexpr size_t kSegmentBytes = 3, kTexelsASegment = 8, kLinksATexel = 500;
// Texels that are larger for want of memory get larger by this factor at a time, so that moves,
// which change the area by rounding, do not change them.
constexpr float kSideStep = 1.1f;
// Texels whose links are found at a time, the work of one in rays besides its tests, and tests of
// known answer that take as long as a ray.
constexpr size_t kLinkedAtATime = 64;
constexpr uint64_t kRaysALinkedTexel = 64, kKnownARay = 8;

double areaOf(const RenderScene& scene) {
  double area = 0.0;
  for (const RenderObject& o : scene.objects)
    if (!o.isAreaLight) area += areaOf(scene, o);
  return area;
}

// By object.
std::vector<TexelRadiosity::Sides> sidesOf(const RenderScene& scene) {
  std::vector<TexelRadiosity::Sides> out;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    TexelRadiosity::Sides& s = out.emplace_back();
    if (!scene.slots[o].mesh || scene.objects[o].isEmpty()) continue;
    const Material& m = scene.materials[static_cast<size_t>(scene.objects[o].material)];
    s.isClear = m.isClear();
    s.isDoubleSided = m.doubleSided;
    s.isMasked = m.alphaMode == AlphaMode::mask;
    if (!s.isMasked) continue;
    s.cutoff = m.alphaCutoff;
    s.opacity = m.baseColor.a;
    s.texture = m.baseColorTexture;
  }
  return out;
}

}  // namespace

float texelSideOf(const RenderScene& scene, const TexelRadiosityOptions& options) {
  const size_t bytes =
      options.map.pixels() * kSegmentBytes / kTexelsASegment + kLinksATexel * sizeof(TexelLink);
  const double most = std::max(1.0, static_cast<double>(options.memory / bytes));
  const double factor = std::sqrt(areaOf(scene) / most) / static_cast<double>(options.texel);
  if (factor <= 1.0) return options.texel;
  const double steps = std::ceil(std::log(factor) / std::log(static_cast<double>(kSideStep)));
  return options.texel * static_cast<float>(std::pow(static_cast<double>(kSideStep), steps));
}

// Finds the texels anew if surfaces are at other places. Returns whether that is so. While surfaces
// move, the old texels stay: those of a moved object go with it.
bool TexelRadiosity::takeGeometry(const RenderScene& scene, Services& services,
                                  const RenderSceneChanges& changes) {
  const bool isOther = !isStarted_ || changes.rebuilt;
  const bool isMoving = std::ranges::any_of(
      changes.movedObjects, [&](uint32_t o) { return scene.slots[o].mesh != nullptr; });
  // Objects that came or went, or let other rays through.
  const bool isReplaced = (changes.objects && isMoving) || (changes.materials && takeSides(scene));
  moved_.insert(changes.movedObjects.begin(), changes.movedObjects.end());
  isStale_ = isStale_ || isOther || isMoving || isReplaced;
  if (!changes.movedObjects.empty() && !isOther && !isReplaced) {
    // The places of moved objects, so that pixels find their texels.
    takeAtlases(services);
    return false;
  }
  if (!isStale_) {
    if (moved_.empty()) return false;
    // Area lights alone moved: they block the light of others.
    light_.outdate(places_.movesTo(scene, texels_, moved_), false);
    places_ = PlacedTexels(scene, texels_);
    movedSinceLinks_.insert(moved_.begin(), moved_.end());
    moved_.clear();
    return false;
  }
  isStarted_ = true;
  isStale_ = false;
  ++texelVersion_;
  takeSides(scene);
  const float side = texelSideOf(scene, options_);
  const bool isAnew =
      isOther || side != counts_.texel || options_.visibility == TexelVisibility::stored;
  counts_.texel = side;
  takeAtlases(services);
  texels_ = TexelSet(scene, atlases_, options_.order);
  counts_.rays += texels_.findBuried(scene, services.rays());
  counts_.rays += neighbours_.find(scene, services.rays(), texels_);
  const TexelTree before = std::exchange(tree_, TexelTree(texels_));
  const TexelMoves moves = places_.movesTo(scene, texels_, moved_);
  if (changes.rebuilt) irradiance_.clear();
  if (!irradiance_.empty()) irradiance_ = moves.carried(irradiance_);
  if (isAnew) {
    depths_.restart(scene, texels_, options_.map);
    hasLookedOnDisk_ = false;
    depthKey_.reset();
    links_.restart(texels_, options_.linkError);
    light_.restart();
  } else {
    if (links_.isDone()) {
      placesOfLinks_ = places_;
      movedSinceLinks_.clear();
    }
    movedSinceLinks_.insert(moved_.begin(), moved_.end());
    links_.restart(before, texels_, tree_,
                   placesOfLinks_.movesTo(scene, texels_, movedSinceLinks_));
    light_.outdate(moves, true);
  }
  places_ = PlacedTexels(scene, texels_);
  moved_.clear();
  findAlbedo(scene);
  return true;
}

// Counts objects whose material lets other rays through as moved. Returns whether there are any.
bool TexelRadiosity::takeSides(const RenderScene& scene) {
  const std::vector<Sides> before = std::exchange(sides_, sidesOf(scene));
  bool isOther = false;
  for (uint32_t o = 0; o < std::min(before.size(), sides_.size()); ++o) {
    if (before[o] == sides_[o]) continue;
    moved_.insert(o);
    isOther = true;
  }
  return isOther;
}

void TexelRadiosity::takeAtlases(Services& services) {
  const auto atlases = services.charts(1.0f / counts_.texel);
  atlases_.assign(atlases.begin(), atlases.end());
}

void TexelRadiosity::findAlbedo(const RenderScene& scene) {
  albedo_.resize(texels_.size());
  tbb::parallel_for(size_t{0}, texels_.size(), [&](size_t t) {
    const SurfaceTexel& texel = texels_[t];
    albedo_[t] = vec3(0.0f);
    for (const SurfacePlace& place : texel.spread)
      albedo_[t] += albedoAt(scene, texel.object, place) / static_cast<float>(texel.spread.size());
  });
}

void TexelRadiosity::findLinks(const RenderScene& scene, const RayCaster& rays, uint64_t most) {
  const Visibility byRays = [&](uint32_t t, const vec3& point) {
    return seesByRay(scene, rays, texels_[t], point);
  };
  const Visibility byDepths = [&](uint32_t t, const vec3& point) {
    return depths_.sees(texels_[t], t, point);
  };
  for (uint64_t spent = 0; !links_.isDone() && spent < most;) {
    links_.goOn(texels_, tree_, usesDepths() ? byDepths : byRays, kLinkedAtATime);
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
  if (other != options_) isStarted_ = false;
  const bool isSame = isStarted_ && options == options_ && changes.none();
  if (isSame && isDone()) return;
  options_ = options;
  const RayCaster& rays = services.rays();
  if (!isSame) {
    lights_ = LightSet(scene, lights_);
    isLit_ = false;
  }
  if (!takeGeometry(scene, services, changes) && (changes.materials || changes.objects))
    findAlbedo(scene);
  counts_.rays += light_.update(scene, rays, lights_, texels_, changes.movedObjects, options.seed,
                                mostRays / 2);
  isLit_ = isLit_ && !light_.changed();
  if (!isStale_ && usesDepths()) findDepths(scene, services, mostRays);
  if (!isStale_ && (!usesDepths() || depths_.isDone())) {
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
    depthKey_ = DepthCache::keyOf(scene, texels_, options_.map);
    // What is on disk need not be saved.
    if (depthKey_ && files.load(*depthKey_, depths_)) depthKey_.reset();
  }
  hasLookedOnDisk_ = true;
  if (!depths_.isDone())
    counts_.rays +=
        depths_.goOn(scene, services.rays(), texels_, mostRays - std::min(mostRays, counts_.rays));
  if (!depths_.isDone()) return;
  if (depthKey_) files.save(*std::exchange(depthKey_, std::nullopt), depths_);
}

void TexelRadiosity::findSky(const RenderScene& scene, const RayCaster& rays, uint64_t most) {
  const auto byRays = [&](uint32_t t, const vec3& direction) {
    return !blocksBouncedLight(scene, rays, {texels_[t].spot.rayOrigin(), 0.0f, direction});
  };
  const auto byDepths = [&](uint32_t t, const vec3& direction) {
    return depths_.isOpen(t, depths_.layout().pixelOf(direction));
  };
  const uint64_t tested = usesDepths() ? light_.updateSky(scene, lights_, texels_, byDepths, most)
                                       : light_.updateSky(scene, lights_, texels_, byRays, most);
  if (!usesDepths()) counts_.rays += tested;
  isLit_ = isLit_ && !light_.changed();
}

// Jacobi iterations: what texels reflect is averaged upwards, then gathered along the links.
void TexelRadiosity::bounce() {
  std::vector<vec3> direct(texels_.size()), byNode;
  light_.sum(lights_, direct);
  irradiance_.assign(texels_.size(), vec3(0.0f));
  radiosity_.assign(texels_.size(), vec3(0.0f));
  for (int b = 0; b < options_.bounces; ++b) {
    for (size_t t = 0; t < radiosity_.size(); ++t)
      radiosity_[t] = albedo_[t] * (direct[t] + irradiance_[t]);
    tree_.pull(radiosity_, byNode);
    links_.gather(byNode, irradiance_);
  }
  isLit_ = light_.isDone();
  ++version_;
}

TexelBlend TexelRadiosity::blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                                   uint32_t triangle, bool isBack, const vec3& position) const {
  if (object >= atlases_.size()) return {};
  const ObjectAtlas& own = atlases_[object];
  if (!own.atlas || own.atlas->chartOfTriangle[triangle] == kNone) return {};
  TexelBlend blend = texels_.blendAt(object, isBack, own.texelsOf(triangle, position));
  neighbours_.keepVisible(scene, rays, texels_, position, blend);
  return blend;
}

std::optional<std::vector<TexelSender>> TexelRadiosity::sendersTo(const RenderScene& scene,
                                                                  const RayCaster& rays,
                                                                  uint32_t object,
                                                                  uint32_t triangle, bool isBack,
                                                                  const vec3& position) const {
  if (!unseen_.none() || !links_.isDone() || irradiance_.empty() ||
      radiosity_.size() != texels_.size())
    return std::nullopt;
  return lamplighter::sendersTo(blendAt(scene, rays, object, triangle, isBack, position), texels_,
                                tree_, links_, radiosity_);
}

bool TexelRadiosity::isDone() const {
  return !isStale_ && moved_.empty() && isLit_ && links_.isDone() &&
         (!usesDepths() || depths_.isDone()) && unseen_.none();
}

float TexelRadiosity::progress() const {
  return usesDepths() ? 0.5f * (depths_.progress() + links_.progress()) : links_.progress();
}

}  // namespace lamplighter
