#include "renderer/surface_depths/texel_radiosity.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// What memory a texel is expected to take: of each pixel a segment of three bytes for eight texels,
// and so many links.
constexpr size_t kSegmentBytes = 3, kTexelsASegment = 8, kLinksATexel = 500;
// Rays that take about as long as the links of a texel.
constexpr uint64_t kRaysALinkedTexel = 512;

double areaOf(const RenderScene& scene) {
  double area = 0.0;
  for (const RenderObject& o : scene.objects) {
    if (o.isAreaLight) continue;
    for (uint32_t i = o.firstIndex; i < o.firstIndex + o.indexCount; i += 3) {
      const vec3& a = scene.positions[scene.indices[i]];
      area += 0.5 * static_cast<double>(
                        glm::length(glm::cross(scene.positions[scene.indices[i + 1]] - a,
                                               scene.positions[scene.indices[i + 2]] - a)));
    }
  }
  return area;
}

// By anything but area lights, which do not block bounced light, so that they can move freely.
bool isBlocked(const RenderScene& scene, const RayCaster& rays, Ray ray) {
  for (Hit hit = rays.intersect(ray); hit; hit = rays.intersect(ray)) {
    if (!scene.objects[hit.object].isAreaLight) return true;
    ray.tNear = hit.t + rayEpsilon(ray.origin + hit.t * ray.direction) / glm::length(ray.direction);
  }
  return false;
}

// Of each object with a mesh.
std::vector<TexelRadiosity::Sides> sidesOf(const RenderScene& scene) {
  std::vector<TexelRadiosity::Sides> out;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    if (!scene.slots[o].mesh) continue;
    const Material& m = scene.materials[static_cast<size_t>(scene.objects[o].material)];
    TexelRadiosity::Sides& s = out.emplace_back();
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

float sideOf(const RenderScene& scene, const TexelRadiosityOptions& options) {
  const size_t bytes =
      options.map.pixels() * kSegmentBytes / kTexelsASegment + kLinksATexel * sizeof(TexelLink);
  const double most = std::max(1.0, static_cast<double>(options.memory / bytes));
  return std::max(options.texel, static_cast<float>(std::sqrt(areaOf(scene) / most)));
}

}  // namespace

// Finds the texels anew if surfaces are at other places. Returns whether that is so. While surfaces
// move, the old texels stay: those of a moved object go with it.
bool TexelRadiosity::takeGeometry(const RenderScene& scene, Services& services,
                                  const RenderSceneChanges& changes) {
  const bool hasOtherSides = changes.materials && sidesOf(scene) != sides_;
  const bool isMoving = std::ranges::any_of(
      changes.movedObjects, [&](uint32_t o) { return scene.slots[o].mesh != nullptr; });
  const bool isOther =
      !isStarted_ || changes.rebuilt || (changes.objects && isMoving) || hasOtherSides;
  isStale_ = isStale_ || isOther || isMoving;
  if (!isStale_ || (isMoving && !isOther)) {
    // The places of moved objects, so that pixels find their texels.
    if (!changes.movedObjects.empty()) takeAtlases(services);
    return false;
  }
  isStarted_ = true;
  isStale_ = false;
  ++texelVersion_;
  sides_ = sidesOf(scene);
  counts_.texel = sideOf(scene, options_);
  takeAtlases(services);
  const size_t before = texels_.size();
  texels_ = TexelSet(scene, atlases_, options_.order);
  // Texels of moved objects keep their numbers.
  if (texels_.size() != before || changes.rebuilt || changes.objects) irradiance_.clear();
  counts_.rays += texels_.findBuried(scene, services.rays());
  tree_ = TexelTree(texels_);
  depths_.restart(scene, texels_, options_.map);
  hasLookedOnDisk_ = false;
  depthKey_.reset();
  links_.restart(texels_, options_.linkError);
  light_.restart();
  findAlbedo(scene);
  return true;
}

void TexelRadiosity::takeAtlases(Services& services) {
  const auto atlases = services.charts(1.0f / counts_.texel);
  atlases_.assign(atlases.begin(), atlases.end());
}

void TexelRadiosity::findAlbedo(const RenderScene& scene) {
  albedo_.resize(texels_.size());
  tbb::parallel_for(size_t{0}, texels_.size(), [&](size_t t) {
    albedo_[t] = albedoAt(scene, texels_[t].object, texels_[t].place);
  });
}

void TexelRadiosity::findLinks(const RenderScene& scene, const RayCaster& rays, size_t most) {
  if (options_.visibility == TexelVisibility::stored) {
    links_.goOn(
        texels_, tree_,
        [&](uint32_t t, const vec3& point) { return depths_.sees(texels_[t], t, point); }, most);
    return;
  }
  links_.goOn(
      texels_, tree_,
      [&](uint32_t t, const vec3& point) {
        const vec3 from = texels_[t].spot.rayOrigin(), d = point - from;
        if (glm::dot(d, texels_[t].spot.geometricNormal) <= 0.0f) return false;
        return !isBlocked(scene, rays, {from, 0.0f, d, 1.0f - 1e-3f});
      },
      most);
}

void TexelRadiosity::update(const RenderScene& scene, Services& services,
                            const TexelRadiosityOptions& options, uint64_t mostRays) {
  counts_.rays = 0;
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
  usesDepths_ = options_.visibility == TexelVisibility::stored || !scene.nominalSky.isBlack();
  if (!isStale_ && usesDepths_) findDepths(scene, services, mostRays);
  if (!isStale_ && (!usesDepths_ || depths_.isDone()) && !links_.isDone())
    findLinks(scene, rays, 1 + mostRays / kRaysALinkedTexel);
  if (links_.isDone() && !isLit_) bounce();
  counts_.bytes = depths_.bytes() + links_.bytes() + light_.bytes();
}

// From disk or by rays; then the light of the sky through them.
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
  light_.updateSky(scene, lights_, texels_, depths_);
  isLit_ = isLit_ && !light_.changed();
}

// Jacobi iterations: what texels reflect is averaged upwards, then gathered along the links.
void TexelRadiosity::bounce() {
  std::vector<vec3> direct(texels_.size()), radiosity(texels_.size()), byNode;
  light_.sum(lights_, direct);
  irradiance_.assign(texels_.size(), vec3(0.0f));
  for (int b = 0; b < options_.bounces; ++b) {
    for (size_t t = 0; t < radiosity.size(); ++t)
      radiosity[t] = albedo_[t] * (direct[t] + irradiance_[t]);
    tree_.pull(radiosity, byNode);
    links_.gather(byNode, irradiance_);
  }
  isLit_ = light_.isDone();
  ++version_;
}

bool TexelRadiosity::isDone() const {
  return !isStale_ && isLit_ && links_.isDone() && (!usesDepths_ || depths_.isDone()) &&
         unseen_.none();
}

float TexelRadiosity::progress() const {
  return usesDepths_ ? 0.5f * (depths_.progress() + links_.progress()) : links_.progress();
}

}  // namespace lamplighter
