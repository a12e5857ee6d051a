#include "renderer/texels/scene_texels.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/scene/surface.h"

namespace lamplighter {
namespace {

// By object.
std::vector<SceneTexels::Sides> sidesOf(const RenderScene& scene) {
  std::vector<SceneTexels::Sides> out;
  for (size_t o = 0; o < scene.objects.size(); ++o) {
    SceneTexels::Sides& s = out.emplace_back();
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

SceneTexels::Update SceneTexels::take(const RenderScene& scene, Services& services,
                                      const RenderSceneChanges& changes,
                                      const std::function<float()>& sideOf, TexelOrder order) {
  rays_ = 0;
  Update out;
  const bool isOther = !isStarted_ || changes.rebuilt;
  const bool isMoving = std::ranges::any_of(
      changes.movedObjects, [&](uint32_t o) { return scene.slots[o].mesh != nullptr; });
  // Objects that were added or removed, or whose transparency for rays changed.
  const bool isReplaced = (changes.objects && isMoving) || (changes.materials && takeSides(scene));
  moved_.insert(changes.movedObjects.begin(), changes.movedObjects.end());
  isStale_ = isStale_ || isOther || isMoving || isReplaced;
  if (!changes.movedObjects.empty() && !isOther && !isReplaced) {
    // The positions of moved objects, so that pixels find their texels.
    takeAtlases(services);
    out.change = Change::moving;
    return out;
  }
  if (!isStale_) {
    if (moved_.empty()) return out;
    out.change = Change::lamps;
    out.moves = places_.movesTo(scene, texels_, moved_);
  } else {
    isStarted_ = true;
    isStale_ = false;
    ++version_;
    takeSides(scene);
    const float side = sideOf();
    out.change = Change::found;
    out.isAnew = isOther || side != side_;
    side_ = side;
    takeAtlases(services);
    texels_ = TexelSet(scene, atlases_, order);
    rays_ += texels_.findBuried(scene, services.rays());
    rays_ += neighbours_.find(scene, services.rays(), texels_);
    out.moves = places_.movesTo(scene, texels_, moved_);
  }
  out.before = std::exchange(places_, PlacedTexels(scene, texels_));
  out.moved = std::exchange(moved_, {});
  return out;
}

// Treats objects as moved if their material now blocks rays differently. Returns whether there are
// any.
bool SceneTexels::takeSides(const RenderScene& scene) {
  const std::vector<Sides> before = std::exchange(sides_, sidesOf(scene));
  bool isOther = false;
  for (uint32_t o = 0; o < std::min(before.size(), sides_.size()); ++o) {
    if (before[o] == sides_[o]) continue;
    moved_.insert(o);
    isOther = true;
  }
  return isOther;
}

void SceneTexels::takeAtlases(Services& services) {
  const auto atlases = services.charts(1.0f / side_);
  atlases_.assign(atlases.begin(), atlases.end());
}

TexelBlend SceneTexels::blendAt(const RenderScene& scene, const RayCaster& rays, uint32_t object,
                                uint32_t triangle, bool isBack, const vec3& position) const {
  if (object >= atlases_.size()) return {};
  const ObjectAtlas& own = atlases_[object];
  if (!own.atlas || own.atlas->chartOfTriangle[triangle] == kNone) return {};
  TexelBlend blend = texels_.blendAt(object, isBack, own.texelsOf(triangle, position));
  neighbours_.keepVisible(scene, rays, texels_, position, blend);
  return blend;
}

std::vector<vec3> albedoOf(const RenderScene& scene, const TexelSet& texels) {
  std::vector<vec3> albedo(texels.size(), vec3(0.0f));
  tbb::parallel_for(size_t{0}, texels.size(), [&](size_t t) {
    const SurfaceTexel& texel = texels[t];
    for (const SurfacePlace& place : texel.spread)
      albedo[t] += albedoAt(scene, texel.object, place) / static_cast<float>(texel.spread.size());
  });
  return albedo;
}

float texelSideFor(const RenderScene& scene, float side, size_t most) {
  constexpr double kSideStep = 1.1;
  double area = 0.0;
  for (const RenderObject& o : scene.objects)
    if (!o.isAreaLight) area += areaOf(scene, o);
  const double factor =
      std::sqrt(area / static_cast<double>(std::max<size_t>(most, 1))) / static_cast<double>(side);
  if (factor <= 1.0) return side;
  const double steps = std::ceil(std::log(factor) / std::log(kSideStep));
  return side * static_cast<float>(std::pow(kSideStep, steps));
}

}  // namespace lamplighter
