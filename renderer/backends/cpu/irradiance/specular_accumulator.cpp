#include "renderer/backends/cpu/irradiance/specular_accumulator.h"

#include <algorithm>
#include <atomic>
#include <bit>

#include <tbb/parallel_for.h>

#include "shaders/shared/brdf.h"

namespace lamplighter::cpu {

namespace {

// Tiles per task; they read the texels of a shadow map together.
constexpr size_t kTilesATask = 8;

// Reads the texture at the pixel's position in its triangle.
Gloss glossOf(const RenderScene& scene, const GBuffer& g, size_t i) {
  const RenderObject& object = scene.objects[g.object[i]];
  const Material& m = scene.materials[static_cast<size_t>(object.material)];
  if (m.metallicRoughnessTexture.texture == kNone) return {m.metallic, m.roughness};
  const uint32_t* corner = &scene.indices[object.firstIndex + 3 * g.triangle[i]];
  const vec3 a = scene.positions[corner[0]], b = scene.positions[corner[1]] - a,
             c = scene.positions[corner[2]] - a, p = vec3(g.px[i], g.py[i], g.pz[i]) - a;
  const vec3 area = glm::cross(b, c);
  const float inverse = 1.0f / std::max(glm::dot(area, area), 1e-30f);
  const float u = std::clamp(glm::dot(glm::cross(p, c), area) * inverse, 0.0f, 1.0f);
  const float v = std::clamp(glm::dot(glm::cross(b, p), area) * inverse, 0.0f, 1.0f - u);
  return glossAt(scene, g.object[i], g.triangle[i], u, v);
}

// Assumes that a texture can have any value.
LightProxies::Lobes lobesOf(const RenderScene& scene, uint32_t object, float leastRoughness) {
  const Material& m = scene.materials[static_cast<size_t>(scene.objects[object].material)];
  const bool isKnown = m.metallicRoughnessTexture.texture == kNone;
  const float roughness = std::max(isKnown ? m.roughness : 0.0f, leastRoughness);
  return {roughness * roughness};
}

// By object: whether any part of it is glossy.
std::vector<uint8_t> findGlossy(const RenderScene& scene) {
  std::vector<uint8_t> mayBe;
  for (const RenderObject& object : scene.objects)
    mayBe.push_back(mayBeGlossy(scene.materials[static_cast<size_t>(object.material)]));
  return mayBe;
}

}  // namespace

void SpecularAccumulator::clear() {
  if (isOn_) *this = SpecularAccumulator();
}

void SpecularAccumulator::findParts(const RenderScene& scene, const GBuffer& g, size_t index,
                                    std::span<const uint8_t> mayBeGlossy,
                                    const PatchLights* patches) {
  Tile& tile = tiles_[index];
  tile.parts.clear();
  tile.gloss.clear();
  const uint64_t only = g.onlyTriangle[index];
  const bool mayBeSome = only == GBuffer::kMany || mayBeGlossy[only >> 32] != 0;
  for (size_t in = 0; mayBeSome && in < kTilePixels; ++in) {
    const size_t i = index * kTilePixels + in;
    if (g.hit[i] == 0 || mayBeGlossy[g.object[i]] == 0) continue;
    const Gloss gloss = glossOf(scene, g, i);
    if (!shared::isGlossy(gloss.metallic, gloss.roughness)) continue;
    if (tile.gloss.empty()) tile.gloss.resize(kTilePixels);
    tile.gloss[in] = gloss;
    const auto packet = static_cast<uint8_t>(in / kLanes);
    Patch patch{scene.hasLinks ? g.object[i] : 0, 0};
    if (patches != nullptr)
      patch = {
          g.object[i],
          patches->patches(g.object[i]).leafAt(g.triangle[i], vec3(g.px[i], g.py[i], g.pz[i]))};
    auto it = std::find_if(tile.parts.rbegin(), tile.parts.rend(),
                           [&](const Part& p) { return p.packet != packet || p.patch == patch; });
    if (it == tile.parts.rend() || it->packet != packet) {
      tile.parts.push_back({packet, 0, 0, patch});
      it = tile.parts.rbegin();
    }
    it->lanes |= static_cast<uint8_t>(1u << in % kLanes);
  }
  tile.gloss.shrink_to_fit();
  tile.radiance.assign(tile.gloss.size(), vec3(0.0f));
  tile.radiance.shrink_to_fit();
}

// By row: whether its shadow modes changed.
std::vector<bool> SpecularAccumulator::findUses(const RenderScene& scene, float leastRoughness,
                                                const PatchLights& patches) {
  rows_.clear();
  for (Tile& tile : tiles_)
    for (Part& part : tile.parts) {
      part.row = rows_.try_emplace(part.patch, static_cast<uint32_t>(rows_.size())).first->second;
    }
  std::vector<ShadowMode> last = std::move(uses_);
  slots_ = patches.slots();
  uses_.assign(rows_.size() * slots_, ShadowMode::skip);
  for (const auto& [patch, row] : rows_)
    patches.uses(patch.first, patch.second, lobesOf(scene, patch.first, leastRoughness),
                 {uses_.data() + row * slots_, slots_});
  std::vector<bool> isOther(rows_.size(), true);
  if (last.size() == uses_.size())
    for (size_t row = 0; row < rows_.size(); ++row)
      isOther[row] = !std::equal(uses_.data() + row * slots_, uses_.data() + (row + 1) * slots_,
                                 last.data() + row * slots_);
  return isOther;
}

uint64_t SpecularAccumulator::update(const RenderScene& scene, const GBuffer& g, const vec3& eye,
                                     std::vector<SpecularLight> lights,
                                     const SumConstants& constants, float leastRoughness,
                                     const PatchLights* patches) {
  const bool hasPatches = patches != nullptr;
  if (tiles_.size() != static_cast<size_t>(g.tiles())) {
    tiles_.assign(static_cast<size_t>(g.tiles()), {});
    knowsPlaces_ = false;
  }
  knowsPlaces_ = knowsPlaces_ && hasPatches == hasPatches_;
  const bool all = !isOn_ || !isKnown_ || !knowsPlaces_ || constants != constants_ ||
                   leastRoughness != leastRoughness_ || eye != eye_ || lights != lights_;
  std::vector<size_t> found;
  for (size_t i = 0; i < tiles_.size(); ++i)
    if (!knowsPlaces_ || tiles_[i].revision != g.revision[i]) found.push_back(i);
  const std::vector<uint8_t> mayBeGlossy = findGlossy(scene);
  tbb::parallel_for(size_t{0}, found.size(),
                    [&](size_t i) { findParts(scene, g, found[i], mayBeGlossy, patches); });
  std::vector<bool> isOther;
  if (hasPatches) isOther = findUses(scene, leastRoughness, *patches);

  std::vector<size_t> stale;
  for (size_t i = 0; i < tiles_.size(); ++i) {
    const Tile& tile = tiles_[i];
    const bool usesChanged =
        hasPatches && std::any_of(tile.parts.begin(), tile.parts.end(),
                                  [&](const Part& p) { return isOther[p.row]; });
    if (!tile.parts.empty() && (all || usesChanged || tile.revision != g.revision[i]))
      stale.push_back(i);
  }
  isKnown_ = false;  // until the update is complete
  std::atomic<uint64_t> pixels = 0;
  const size_t tasks = (stale.size() + kTilesATask - 1) / kTilesATask;
  tbb::parallel_for(size_t{0}, tasks, [&](size_t task) {
    std::vector<std::pair<size_t, const Part*>> parts;  // with their tiles
    for (size_t k = task * kTilesATask; k < std::min((task + 1) * kTilesATask, stale.size()); ++k)
      for (const Part& part : tiles_[stale[k]].parts) parts.emplace_back(stale[k], &part);
    uint64_t here = 0;
    for (size_t first = 0; first < parts.size(); first += SpecularBlock::kMost) {
      const auto some =
          std::span(parts).subspan(first, std::min(SpecularBlock::kMost, parts.size() - first));
      SpecularBlock block(g, eye, constants, leastRoughness);
      const auto packetOf = [](const Part& part) {
        return static_cast<size_t>(part.packet) * kLanes;
      };
      for (const auto& [tile, part] : some) {
        const Gloss* gloss = &tiles_[tile].gloss[packetOf(*part)];
        block.add(tile * kTilePixels + packetOf(*part), part->lanes,
                  std::span<const Gloss, kLanes>(gloss, kLanes),
                  hasPatches ? uses_.data() + part->row * slots_ : nullptr,
                  scene.hasLinks ? scene.objects[part->patch.first].leftOutBy : 0);
        here += static_cast<uint64_t>(std::popcount(part->lanes));
      }
      block.sum(lights);
      for (size_t k = 0; k < some.size(); ++k) {
        vec3* radiance = &tiles_[some[k].first].radiance[packetOf(*some[k].second)];
        block.read(k, std::span<vec3, kLanes>(radiance, kLanes));
      }
    }
    pixels += here;
  });
  for (size_t i = 0; i < tiles_.size(); ++i) tiles_[i].revision = g.revision[i];
  lights_ = std::move(lights);
  constants_ = constants;
  leastRoughness_ = leastRoughness;
  eye_ = eye;
  hasPatches_ = hasPatches;
  isOn_ = isKnown_ = knowsPlaces_ = true;
  return pixels * lights_.size();
}

void SpecularAccumulator::addTo(const GBuffer& g, Image& picture) const {
  if (!isOn_) return;
  tbb::parallel_for(0, g.tiles(), [&](int t) {
    const Tile& tile = tiles_[static_cast<size_t>(t)];
    if (tile.gloss.empty()) return;
    const int x0 = t % g.tilesX * kTileSize, y0 = t / g.tilesX * kTileSize;
    for (int y = y0; y < std::min(y0 + kTileSize, picture.height); ++y) {
      for (int x = x0; x < std::min(x0 + kTileSize, picture.width); ++x) {
        const size_t i = g.index(x, y);
        if (g.hit[i] == 0) continue;
        const Gloss gloss = tile.gloss[i % kTilePixels];
        if (!shared::isGlossy(gloss.metallic, gloss.roughness)) continue;
        const vec3 toEye = glm::normalize(eye_ - vec3(g.px[i], g.py[i], g.pz[i]));
        const float nv = glm::dot(toEye, vec3(g.sx[i], g.sy[i], g.sz[i]));
        const float share =
            shared::diffuseShare(gloss.metallic, gloss.roughness, leastRoughness_, nv);
        const vec3 emission = g.emission(i);
        vec3& pixel = picture.at(x, y);
        pixel = emission + share * (pixel - emission) + tile.radiance[i % kTilePixels];
      }
    }
  });
}

size_t SpecularAccumulator::bytes() const {
  size_t bytes = uses_.size() + lights_.size() * sizeof(SpecularLight);
  for (const Tile& tile : tiles_)
    bytes +=
        tile.parts.size() * sizeof(Part) + tile.radiance.size() * (sizeof(vec3) + sizeof(Gloss));
  return bytes;
}

}  // namespace lamplighter::cpu
