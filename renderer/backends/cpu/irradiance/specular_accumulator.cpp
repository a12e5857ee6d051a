#include "renderer/backends/cpu/irradiance/specular_accumulator.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/irradiance/specular_shading.h"
#include "shaders/shared/brdf.h"

namespace lamplighter::cpu {

namespace {

// Tiles per task; they read the texels of a shadow map together.
constexpr size_t kTilesATask = 8;

// Most memory of copies of maps that changed since the last sum [bytes].
constexpr size_t kMostOldMapBytes = size_t{16} << 20;

// Whether subtracting and adding `changed` lights takes longer than summing all.
bool isMost(size_t changed, size_t all) { return 2 * changed > all; }

// Assumes that a texture can have any value.
LightProxies::Lobes lobesOf(const RenderScene& scene, uint32_t object, float leastRoughness) {
  const Material& m = scene.materials[static_cast<size_t>(scene.objects[object].material)];
  const bool isKnown = m.metallicRoughnessTexture.texture == kNone;
  const float roughness = std::max(isKnown ? m.roughness : 0.0f, leastRoughness);
  return {roughness * roughness};
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
  tile.gloss = findGloss(scene, g, index, mayBeGlossy);
  for (size_t in = 0; in < tile.gloss.size(); ++in) {
    if (!shared::isGlossy(tile.gloss[in].metallic, tile.gloss[in].roughness)) continue;
    const size_t i = index * kTilePixels + in;
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
  tile.sums = std::vector<double>(3 * tile.gloss.size(), 0.0);
}

vec3 SpecularAccumulator::Tile::radiance(size_t pixel) const {
  const double* channel = &sums[3 * kLanes * (pixel / kLanes) + pixel % kLanes];
  return {static_cast<float>(channel[0]), static_cast<float>(channel[kLanes]),
          static_cast<float>(channel[size_t{2} * kLanes])};
}

void SpecularAccumulator::mapChanges(int slot, std::span<const float> map) {
  if (!isKnown_ || !hasGlossy_ || oldMaps_.contains(slot)) return;
  const bool isSummed = std::any_of(lights_.begin(), lights_.end(), [&](const SpecularLight& l) {
    return l.record.mapSlot == slot;
  });
  if (!isSummed) return;
  if (isMost(oldMaps_.size() + 1, lights_.size()) ||
      (oldMaps_.size() + 1) * map.size_bytes() > kMostOldMapBytes)
    return forgetMaps();
  oldMaps_.emplace(slot, std::vector<float>(map.begin(), map.end()));
}

SpecularAccumulator::Changes SpecularAccumulator::findChanges(
    std::span<const SpecularLight> lights) const {
  Changes out;
  const auto bySlot = [](std::span<const SpecularLight> from) {
    std::map<int, const SpecularLight*> slots;
    for (const SpecularLight& light : from) slots.emplace(light.record.slot, &light);
    return slots;
  };
  const auto before = bySlot(lights_);
  out.bySlot = bySlot(lights);
  const auto& now = out.bySlot;
  // Without slots, lights cannot be identified.
  if (before.size() != lights_.size() || now.size() != lights.size()) return out;
  const auto stays = [&](const SpecularLight& light, const auto& others) {
    const auto other = others.find(light.record.slot);
    return other != others.end() && *other->second == light &&
           !oldMaps_.contains(light.record.mapSlot);
  };
  for (const SpecularLight& light : lights_) {
    if (stays(light, now)) {
      if (light.record.slot < 0) continue;
      const auto slot = static_cast<size_t>(light.record.slot);
      out.stays.resize(std::max(out.stays.size(), slot + 1), 0);
      out.stays[slot] = 1;
      continue;
    }
    out.taken.push_back(light);
    const auto old = oldMaps_.find(light.record.mapSlot);
    if (old != oldMaps_.end()) out.taken.back().record.map = old->second.data();
  }
  for (const SpecularLight& light : lights) {
    if (!stays(light, before)) out.added.push_back(light);
  }
  out.all = isMost(std::max(out.taken.size(), out.added.size()), lights.size());
  return out;
}

// Gives the parts of these tiles their rows. Rows of patches that are no longer visible are kept
// until all tiles are updated.
void SpecularAccumulator::findRows(std::span<const size_t> tiles) {
  if (tiles.size() == tiles_.size()) {
    rowOf_.clear();
    rows_.clear();
    usesAreKnown_.clear();
  }
  for (const size_t tile : tiles)
    for (Part& part : tiles_[tile].parts) {
      const auto [it, isNew] = rowOf_.try_emplace(part.patch, static_cast<uint32_t>(rows_.size()));
      if (isNew) rows_.push_back(part.patch);
      part.row = it->second;
    }
}

// By row: the slots of lights that stay but get another shadow mode; none: the last modes are
// unknown, or most of them changed.
std::vector<SpecularAccumulator::OtherUses> SpecularAccumulator::findUses(
    const RenderScene& scene, float leastRoughness, const PatchLights& patches,
    std::span<const uint8_t> stays) {
  if (slots_ != patches.slots()) usesAreKnown_.clear();
  slots_ = patches.slots();
  std::vector<uint8_t> inUse(rows_.size(), 0);
  for (const Tile& tile : tiles_)
    for (const Part& part : tile.parts) inUse[part.row] = 1;
  usesAreKnown_.resize(rows_.size(), 0);
  uses_.resize(rows_.size() * slots_, ShadowMode::skip);
  usesBefore_.resize(uses_.size(), ShadowMode::skip);
  std::vector<OtherUses> others(rows_.size());
  tbb::parallel_for(size_t{0}, rows_.size(), [&](size_t row) {
    const bool wasKnown = std::exchange(usesAreKnown_[row], inUse[row]) != 0;
    if (inUse[row] == 0) return;
    ShadowMode* uses = uses_.data() + row * slots_;
    ShadowMode* was = usesBefore_.data() + row * slots_;
    std::copy_n(uses, slots_, was);
    const auto& [object, leaf] = rows_[row];
    patches.uses(object, leaf, lobesOf(scene, object, leastRoughness), {uses, slots_});
    if (!wasKnown) return;
    std::vector<int>& differ = others[row].emplace();
    for (size_t slot = 0; slot < std::min(slots_, stays.size()); ++slot)
      if (stays[slot] != 0 && uses[slot] != was[slot]) differ.push_back(static_cast<int>(slot));
    if (isMost(differ.size(), slots_)) others[row].reset();
  });
  return others;
}

// Sums all lights or the changes of some parts. Returns the number of lights × pixels.
template <typename Sum>
uint64_t SpecularAccumulator::sumParts(const RenderScene& scene, const GBuffer& g,
                                       std::span<const TilePart> parts,
                                       std::span<const SpecularLight> lights,
                                       const Changes& changes, std::span<const OtherUses> others) {
  uint64_t pixels = 0;
  for (size_t first = 0; first < parts.size(); first += kMostSpecularParts) {
    const auto some = parts.subspan(first, std::min(kMostSpecularParts, parts.size() - first));
    SpecularBlock<Sum> block(g, eye_, constants_, leastRoughness_);
    for (const auto& [tile, part] : some) {
      const size_t packet = static_cast<size_t>(part->packet) * kLanes;
      SpecularUses uses;
      if (hasPatches_)
        uses = {uses_.data() + part->row * slots_, usesBefore_.data() + part->row * slots_};
      block.add(tile * kTilePixels + packet, part->lanes,
                std::span<const Gloss, kLanes>(&tiles_[tile].gloss[packet], kLanes), uses,
                scene.hasLinks ? scene.objects[part->patch.first].leftOutBy : 0);
      pixels += static_cast<uint64_t>(std::popcount(part->lanes));
    }
    if (changes.all) {
      block.add(lights);
    } else {
      block.takeAway(changes.taken);
      block.add(changes.added);
      std::vector<int> slots;
      for (const auto& [tile, part] : some)
        if (hasPatches_ && others[part->row])
          slots.insert(slots.end(), others[part->row]->begin(), others[part->row]->end());
      std::sort(slots.begin(), slots.end());
      slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
      for (const int slot : slots) block.changeUses(*changes.bySlot.at(slot));
    }
    for (size_t k = 0; k < some.size(); ++k) {
      const auto& [tile, part] = some[k];
      std::array<double, size_t{3} * kLanes> change;
      block.read(k, change);
      double* sums = &tiles_[tile].sums[size_t{3} * kLanes * part->packet];
      for (size_t i = 0; i < change.size(); ++i)
        if ((part->lanes >> i % kLanes & 1) != 0)
          sums[i] = change[i] + (changes.all ? 0.0 : sums[i]);
    }
  }
  return pixels * (changes.all ? lights.size() : changes.taken.size() + changes.added.size());
}

// How many of these tiles can be summed within a limit of lights × pixels; at least one.
size_t SpecularAccumulator::fitting(std::span<const size_t> tiles, size_t lights,
                                    uint64_t mostLightPixels) const {
  uint64_t cost = 0;
  for (size_t k = 0; k < tiles.size(); ++k) {
    for (const Part& part : tiles_[tiles[k]].parts)
      cost += lights * static_cast<uint64_t>(std::popcount(part.lanes));
    if (cost > mostLightPixels) return std::max<size_t>(k, 1);
  }
  return tiles.size();
}

uint64_t SpecularAccumulator::update(const RenderScene& scene, const GBuffer& g, const vec3& eye,
                                     std::vector<SpecularLight> lights,
                                     const SumConstants& constants, float leastRoughness,
                                     const PatchLights* patches, bool isKept,
                                     uint64_t mostLightPixels) {
  const bool hasPatches = patches != nullptr;
  if (tiles_.size() != static_cast<size_t>(g.tiles())) {
    tiles_.assign(static_cast<size_t>(g.tiles()), {});
    knowsPlaces_ = false;
  }
  knowsPlaces_ = knowsPlaces_ && hasPatches == hasPatches_;
  const bool isOther = !isOn_ || !isKnown_ || !knowsPlaces_ || isKept != isKept_ ||
                       (!isKept && !oldMaps_.empty()) || constants != constants_ ||
                       leastRoughness != leastRoughness_ || eye != eye_;
  Changes changes = isOther ? Changes() : findChanges(lights);
  // Float sums begin from scratch where anything changed.
  if (!isKept) changes.all = isOther || !changes.taken.empty() || !changes.added.empty();
  std::vector<size_t> found;
  for (size_t i = 0; i < tiles_.size(); ++i)
    if (!knowsPlaces_ || tiles_[i].revision != g.revision[i]) found.push_back(i);
  const std::vector<uint8_t> mayBeGlossy = findGlossy(scene);
  tbb::parallel_for(size_t{0}, found.size(),
                    [&](size_t i) { findParts(scene, g, found[i], mayBeGlossy, patches); });
  findRows(found);
  std::vector<OtherUses> others;
  if (hasPatches) others = findUses(scene, leastRoughness, *patches, changes.stays);
  constants_ = constants;
  leastRoughness_ = leastRoughness;
  eye_ = eye;
  isKept_ = isKept;
  hasPatches_ = hasPatches;

  hasGlossy_ = std::any_of(tiles_.begin(), tiles_.end(),
                           [](const Tile& tile) { return !tile.parts.empty(); });
  std::vector<size_t> fresh, kept;  // tiles to sum from scratch, and tiles to change
  const bool anyChanged = !changes.taken.empty() || !changes.added.empty();
  for (size_t i = 0; i < tiles_.size(); ++i) {
    const Tile& tile = tiles_[i];
    if (tile.parts.empty()) continue;
    const auto isAny = [&](const auto& is) {
      return hasPatches && std::any_of(tile.parts.begin(), tile.parts.end(),
                                       [&](const Part& p) { return is(others[p.row]); });
    };
    if (changes.all || tile.revision != g.revision[i] ||
        isAny([&](const OtherUses& uses) { return !uses || (!isKept && !uses->empty()); }))
      fresh.push_back(i);
    else if (anyChanged || isAny([](const OtherUses& uses) { return !uses->empty(); }))
      kept.push_back(i);
  }
  isKnown_ = false;  // until the update is complete
  std::atomic<uint64_t> pixels = 0;
  const auto sumTiles = [&](std::span<const size_t> tiles, const Changes& what) {
    tbb::parallel_for(size_t{0}, (tiles.size() + kTilesATask - 1) / kTilesATask, [&](size_t task) {
      const auto some = tiles.subspan(task * kTilesATask);
      std::vector<TilePart> parts;
      for (const size_t tile : some.first(std::min(kTilesATask, some.size())))
        for (const Part& part : tiles_[tile].parts) parts.emplace_back(tile, &part);
      pixels += isKept ? sumParts<ExactSum>(scene, g, parts, lights, what, others)
                       : sumParts<FloatSum>(scene, g, parts, lights, what, others);
    });
  };
  // Tiles that are left to the next call have no revision.
  const size_t now = isKept ? fresh.size() : fitting(fresh, lights.size(), mostLightPixels);
  isComplete_ = now == fresh.size();
  sumTiles(std::span(fresh).first(now), Changes());
  sumTiles(kept, changes);
  for (size_t i = 0; i < tiles_.size(); ++i) tiles_[i].revision = g.revision[i];
  for (const size_t i : std::span(fresh).subspan(now)) tiles_[i].revision = 0;
  lights_ = std::move(lights);
  oldMaps_.clear();
  isOn_ = isKnown_ = knowsPlaces_ = true;
  return pixels;
}

void SpecularAccumulator::addTo(const GBuffer& g, Image& picture, bool hasEmission) const {
  if (!isOn_) return;
  tbb::parallel_for(size_t{0}, tiles_.size(), [&](size_t t) {
    const Tile& tile = tiles_[t];
    forEachGlossy(g, t, tile.gloss, [&](int x, int y, size_t i, const Gloss& gloss) {
      addSpecular(g, i, eye_, gloss, leastRoughness_, tile.radiance(i % kTilePixels), hasEmission,
                  picture.at(x, y));
    });
  });
}

std::optional<SpecularAccumulator::Reflection> SpecularAccumulator::reflection(size_t pixel) const {
  const Tile& tile = tiles_[pixel / kTilePixels];
  if (tile.gloss.empty()) return std::nullopt;
  const Gloss gloss = tile.gloss[pixel % kTilePixels];
  if (!shared::isGlossy(gloss.metallic, gloss.roughness)) return std::nullopt;
  return Reflection{tile.radiance(pixel % kTilePixels), gloss};
}

uint64_t SpecularAccumulator::glossyPixels() const {
  uint64_t pixels = 0;
  for (const Tile& tile : tiles_)
    for (const Part& part : tile.parts) pixels += static_cast<uint64_t>(std::popcount(part.lanes));
  return pixels;
}

size_t SpecularAccumulator::bytes() const {
  size_t bytes = uses_.size() + usesBefore_.size() + lights_.size() * sizeof(SpecularLight);
  for (const Tile& tile : tiles_)
    bytes += tile.parts.size() * sizeof(Part) + tile.sums.size() * sizeof(double) +
             tile.gloss.size() * sizeof(Gloss);
  return bytes;
}

}  // namespace lamplighter::cpu
