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

// Of triangles that texels are on [m²].
std::vector<double> areasOf(const RenderScene& scene) {
  std::vector<double> areas;
  for (const RenderObject& o : scene.objects) {
    if (o.isAreaLight) continue;
    for (uint32_t i = o.firstIndex; i < o.firstIndex + o.indexCount; i += 3) {
      const vec3& a = scene.positions[scene.indices[i]];
      const vec3 b = scene.positions[scene.indices[i + 1]] - a;
      const vec3 c = scene.positions[scene.indices[i + 2]] - a;
      areas.push_back(0.5 * static_cast<double>(glm::length(glm::cross(b, c))));
    }
  }
  return areas;
}

}  // namespace

SceneTexels::Update SceneTexels::take(const RenderScene& scene, Services& services,
                                      const RenderSceneChanges& changes,
                                      const std::function<TexelSize()>& sizeOf, TexelOrder order) {
  rays_ = 0;
  Update out;
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
    const TexelSize size = sizeOf();
    out.change = Change::found;
    out.isAnew = isOther || size != size_;
    size_ = size;
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

// Counts objects whose material lets other rays through as moved. Returns whether there are any.
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
  const auto atlases = services.charts({1.0f / size_.side, size_.mostOfChart});
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

TexelSize texelSizeFor(const RenderScene& scene, float side, size_t most, float shareOfChart) {
  constexpr double kSideStep = 1.1;
  most = std::max<size_t>(most, 1);
  // A chart has two triangles or more.
  const bool isShared = shareOfChart < 1.0f;
  const double mostOfTriangle =
      static_cast<double>(most) * (isShared ? 0.5 * static_cast<double>(shareOfChart) : 1.0);
  TexelSize size{side};
  if (isShared) size.mostOfChart = static_cast<size_t>(2.0 * mostOfTriangle);
  const std::vector<double> areas = areasOf(scene);
  const auto texels = [&] {
    double sum = 0.0;
    for (const double area : areas)
      sum += std::min(area / static_cast<double>(size.side * size.side), mostOfTriangle);
    return sum;
  };
  for (int step = 1; texels() > static_cast<double>(most); ++step)
    size.side = side * static_cast<float>(std::pow(kSideStep, step));
  return size;
}

}  // namespace lamplighter
