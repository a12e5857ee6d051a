#include "renderer/backends/cpu/irradiance/irradiance_accumulator.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <utility>

#include <tbb/parallel_for.h>

#include "renderer/backends/cpu/irradiance/fixed_point_scale.h"
#include "renderer/base/simd.h"
#include "renderer/visibility/hard_shadow_lights.h"

namespace lamplighter::cpu {
namespace {

// Shadow maps that are processed together: they fit into the L2 cache beside the tiles.
constexpr size_t kMapBytesAtOnce = size_t{512} << 10;
// Limit for old shadow maps, which are kept from their change to the next sum.
constexpr size_t kMostOldBytes = size_t{16} << 20;
// Limit for shadow masks; with more, none are kept. Slots are added in steps.
constexpr size_t kMostLitBytes = size_t{32} << 20;
constexpr size_t kLitStep = 64;
constexpr ShadowMapDiff kNoChange{ShadowMapDiff::Extent::nothing};
// Tiles per task, so that each shadow map is loaded from memory once for all of them.
constexpr int kDenseTilesPerTask = 16;
// The same if few of their packets are wanted.
constexpr int kSparseTilesPerTask = 32;
// At least this number of tasks, so that in small pictures no core waits long for the last one.
constexpr int kFewestTasks = 48;

std::vector<const LightRecord*> bySlot(std::span<const LightRecord> lights) {
  std::vector<const LightRecord*> slots;
  for (const LightRecord& light : lights) {
    if (light.slot < 0) continue;
    slots.resize(std::max(slots.size(), static_cast<size_t>(light.slot) + 1));
    slots[static_cast<size_t>(light.slot)] = &light;
  }
  return slots;
}

// Converts eight sums from units to irradiance.
// `fine`: the second part of the sums, or null.
void scalePacket(const int32_t* units, const int32_t* fine, float unit, float* to) {
  const hn::FixedTag<float, kLanes> tag;
  const hn::FixedTag<int32_t, kLanes> intTag;
  auto values = hn::ConvertTo(tag, hn::LoadU(intTag, units));
  if (fine != nullptr)
    values = hn::Add(values, hn::Mul(hn::Set(tag, 1.0f / FixedSums::kFinePerUnit),
                                     hn::ConvertTo(tag, hn::LoadU(intTag, fine))));
  hn::StoreU(hn::Mul(hn::Set(tag, unit), values), tag, to);
}

template <typename Source>
std::vector<Revision> revisionsOf(const Source* source) {
  std::vector<Revision> revisions;
  for (uint32_t i = 0; source != nullptr && i < source->objects(); ++i)
    revisions.push_back(source->revision(i));
  return revisions;
}

// Whether the revision of any object in the source (if any) differs from the last update.
template <typename Source>
bool revised(std::vector<Revision>& last, const Source* source) {
  std::vector<Revision> now = revisionsOf(source);
  const bool isOther = now != last;
  last = std::move(now);
  return isOther;
}

}  // namespace

struct IrradianceAccumulator::Frame {
  const GBuffer& gbuffer;
  std::vector<const LightRecord*> slots;
  const PatchLights* patches;
  std::span<const uint32_t> wanted;  // by tile; empty: all
  std::span<const uint32_t> leftOutBy;
  std::vector<const LightRecord*> all;  // the lights
  // lights and maps: old states that are subtracted, and new states that are added
  std::vector<const LightRecord*> taken, added;
  std::vector<bool> isChanged;               // by slot
  std::vector<PlaceTable::Staying> staying;  // lights that did not move
};

void IrradianceAccumulator::mapChanges(int slot, std::span<const float> map) {
  if (!knowsSums_) return;
  if (const auto old = oldMaps_.find(slot); old != oldMaps_.end()) {
    old->second.isChangedOnce = false;
    return;
  }
  const bool isSummed = std::any_of(lights_.begin(), lights_.end(),
                                    [&](const LightRecord& l) { return l.mapSlot == slot; });
  if (!isSummed) return;
  if (masksAreCached_) {
    oldMaps_.emplace(slot, OldMap());
    return;
  }
  if (isMost(oldMaps_.size() + 1, lights_.size())) return forgetMaps();
  if ((oldMaps_.size() + 1) * map.size_bytes() > kMostOldBytes) return forgetMaps();
  oldMaps_.emplace(slot, OldMap{std::vector<float>(map.begin(), map.end()), {}});
}

void IrradianceAccumulator::mapChanged(int slot, const ShadowMapDiff& change) {
  const auto old = oldMaps_.find(slot);
  if (old != oldMaps_.end() && old->second.isChangedOnce) old->second.change = change;
}

// Whether subtracting and adding `changed` lights costs more than summing all lights.
bool IrradianceAccumulator::isMost(size_t changed, size_t all) const {
  return masksAreCached_ ? 4 * changed > 3 * all : 2 * changed > all;
}

void IrradianceAccumulator::forgetMaps() {
  knowsSums_ = false;
  oldMaps_.clear();
}

// Finds which of the kept sums and places are valid for this frame.
void IrradianceAccumulator::compareWithLast(const Frame& frame) {
  const GBuffer& g = frame.gbuffer;
  const bool hasPatches = frame.patches != nullptr;
  const bool hasMaps = hasPatches && frame.patches->maps() != nullptr;
  const bool hasTransfer = hasPatches && frame.patches->prt() != nullptr;
  if (hasPatches != hasPatches_ || hasMaps != hasMaps_ || hasTransfer != hasTransfer_ ||
      (hasMaps && frame.patches->maps()->coverage() != mapCoverage_) ||
      (hasTransfer && frame.patches->prt()->coverage() != coverage_))
    knowsPlaces_ = false;
  hasPatches_ = hasPatches;
  hasMaps_ = hasMaps;
  hasTransfer_ = hasTransfer;
  mapCoverage_ = hasMaps ? frame.patches->maps()->coverage() : Revision();
  coverage_ = hasTransfer ? frame.patches->prt()->coverage() : Revision();
  const auto tiles = static_cast<size_t>(g.tiles());
  if (sums_.r.size() != g.px.size()) {
    tiles_.assign(tiles, {});
    for (auto* v : {&sums_.r, &sums_.g, &sums_.b}) v->assign(g.px.size(), 0);
    for (auto* v : {&red_, &green_, &blue_}) v->assign(g.px.size(), 0.0f);
  }
  // Packets are cleared before they are summed from scratch.
  for (auto* v : {&sums_.fineR, &sums_.fineG, &sums_.fineB}) {
    if (constants_.isFine) v->resize(g.px.size());
    if (!constants_.isFine && !v->empty()) *v = {};
  }
  if (!knowsPlaces_ || (hasPatches && frame.patches->slots() != table_.slots())) knowsSums_ = false;
  for (size_t i = 0; i < tiles; ++i) {
    Tile& tile = tiles_[i];
    tile.wanted = frame.wanted.empty() ? ~uint32_t{0} : frame.wanted[i];
    if (!knowsSums_ || tile.revision != g.revision[i]) tile.summed = 0;
  }
}

// Decides whether shadow masks are kept: while the view does not change, and if they fit. Returns
// whether the decision is the same as before.
bool IrradianceAccumulator::fitMasks(const Frame& frame) {
  const GBuffer& g = frame.gbuffer;
  size_t same = 0;  // number of tiles
  for (size_t i = 0; i < std::min(tiles_.size(), g.revision.size()); ++i)
    same += tiles_[i].revision == g.revision[i] ? 1 : 0;
  const bool isStill = sums_.r.size() == g.px.size() && 2 * same > g.revision.size();
  maskSlots_ = std::max(maskSlots_, (frame.slots.size() + kLitStep - 1) / kLitStep * kLitStep);
  size_t packets = 0;
  for (const uint32_t wanted : frame.wanted) packets += static_cast<size_t>(std::popcount(wanted));
  if (frame.wanted.empty()) packets = g.px.size() / kLanes;
  const bool was = masksAreCached_;
  masksAreCached_ = cachesMasks_ && isStill && packets * maskSlots_ <= kMostLitBytes;
  if (was && !masksAreCached_)
    for (Tile& tile : tiles_) tile.lit.forget();
  return was == masksAreCached_;
}

void IrradianceAccumulator::keepMasks() {
  if (!masksAreCached_) return;
  tbb::parallel_for(size_t{0}, tiles_.size(),
                    [&](size_t i) { tiles_[i].lit.keep(tiles_[i].wanted, maskSlots_); });
}

void IrradianceAccumulator::findChanges(Frame& frame) {
  for (LightRecord& light : lights_) {
    const auto old = oldMaps_.find(light.mapSlot);
    if (old != oldMaps_.end() && !masksAreCached_) light.map = old->second.texels.data();
  }
  const bool hasPatches = frame.patches != nullptr && hasPatches_;
  const auto before = bySlot(lights_);
  const auto& now = frame.slots;
  frame.isChanged.assign(std::max(before.size(), now.size()), false);
  for (size_t slot = 0; slot < frame.isChanged.size(); ++slot) {
    const LightRecord* was = slot < before.size() ? before[slot] : nullptr;
    const LightRecord* is = slot < now.size() ? now[slot] : nullptr;
    if (was == is) continue;  // the slot is empty
    if (was != nullptr && is != nullptr && was->isInPlaceOf(*is)) {
      const auto old = oldMaps_.find(is->mapSlot);
      const PlaceTable::Staying light{was, is,
                                      old == oldMaps_.end() ? kNoChange : old->second.change};
      if (light.change.extent == ShadowMapDiff::Extent::nothing && !light.isReplaced()) continue;
      if (light.change.extent != ShadowMapDiff::Extent::everything && masksAreCached_ && hasPatches)
        frame.staying.push_back(light);
    }
    if (was != nullptr) frame.taken.push_back(was);
    if (is != nullptr) frame.added.push_back(is);
    frame.isChanged[slot] = true;
  }
}

void IrradianceAccumulator::findPlaces(const Frame& frame) {
  const bool anew = !knowsPlaces_;
  std::vector<size_t> found;
  for (size_t i = 0; i < tiles_.size(); ++i) {
    Tile& tile = tiles_[i];
    if (anew || tile.revision != frame.gbuffer.revision[i]) tile.places.clear();
    if (!tile.places.knows(tile.wanted)) found.push_back(i);
  }
  tbb::parallel_for(size_t{0}, found.size(), [&](size_t i) {
    Tile& tile = tiles_[found[i]];
    tile.places.find(frame.gbuffer, static_cast<int>(found[i]), frame.patches, tile.wanted);
  });
  knowsPlaces_ = true;
  if (frame.patches == nullptr) return;
  if (anew || frame.patches->slots() != table_.slots()) {
    table_.reset(frame.patches->slots());
    for (Tile& tile : tiles_) tile.places.takeRows(table_);
  } else {
    for (const size_t i : found) tiles_[i].places.takeRows(table_);
  }
  std::vector<bool> inUse(table_.rows(), false);
  for (const Tile& tile : tiles_)
    for (const uint32_t row : tile.places.rows()) inUse[row] = true;
  table_.update(*frame.patches, inUse);
}

SumCounts IrradianceAccumulator::update(const GBuffer& gbuffer, std::span<const LightRecord> lights,
                                        SumConstants constants, const PatchLights* patches,
                                        std::span<const uint32_t> wanted,
                                        std::span<const uint32_t> leftOutBy) {
  constants.unitsPerIrradiance = unitsPerIrradiance(lights, constants.clampDistance2);
  constants.isFine = needFineSums(lights, constants.unitsPerIrradiance);
  Frame frame{gbuffer, bySlot(lights), patches, wanted, leftOutBy, {}, {}, {}, {}, {}};
  for (const LightRecord& light : lights) frame.all.push_back(&light);
  const auto hasSlot = [](const LightRecord& light) { return light.slot >= 0; };
  // Without a shadow map a light has no slot to identify it.
  if (constants != constants_ || !std::all_of(lights.begin(), lights.end(), hasSlot) ||
      !std::all_of(lights_.begin(), lights_.end(), hasSlot))
    knowsSums_ = false;
  if (!fitMasks(frame)) knowsSums_ = false;
  if (knowsSums_) {
    findChanges(frame);
    // Lights that did not move are mostly unchanged or only change brightness.
    const size_t changed = std::max(frame.taken.size(), frame.added.size());
    if (isMost(changed - frame.staying.size() / 2, lights.size())) knowsSums_ = false;
  }
  constants_ = constants;
  compareWithLast(frame);
  keepMasks();
  findPlaces(frame);
  if (patches != nullptr && knowsSums_) table_.findTouched(frame.staying);
  frame.isChanged.resize(std::max(frame.isChanged.size(), table_.slots()), false);

  knowsSums_ = false;  // until the update is complete
  std::atomic<uint64_t> lightPixels = 0, lookUps = 0;
  const bool newMaps = revised(mapRevisions_, patches ? patches->maps() : nullptr);
  const bool newTransfer = revised(transferRevisions_, patches ? patches->prt() : nullptr);
  const bool finishAll = newMaps || newTransfer;
  const int tiles = gbuffer.tiles();
  const int most = wanted.empty() ? kDenseTilesPerTask : kSparseTilesPerTask;
  const int aTask = std::clamp(tiles / kFewestTasks, 1, most);
  tbb::parallel_for(0, (tiles + aTask - 1) / aTask, [&](int task) {
    const int first = task * aTask, last = std::min(first + aTask, tiles);
    const SumCounts counts = sumTiles(frame, first, last);
    lightPixels += counts.lightPixels;
    lookUps += counts.lookUps;
    for (int tile = first; tile < last; ++tile)
      if (finishAll || counts.lightPixels > 0 || tiles_[static_cast<size_t>(tile)].begun() != 0)
        finishTile(frame, tile);
  });
  for (size_t i = 0; i < tiles_.size(); ++i) {
    tiles_[i].revision = gbuffer.revision[i];
    tiles_[i].summed = tiles_[i].wanted;
  }
  table_.accept();
  lights_.assign(lights.begin(), lights.end());
  oldMaps_.clear();
  knowsSums_ = true;
  return {lightPixels, lookUps};
}

bool IrradianceAccumulator::isOf(const GBuffer& gbuffer, std::span<const LightRecord> lights,
                                 SumConstants constants, const PatchLights* patches) const {
  constants.unitsPerIrradiance = unitsPerIrradiance(lights, constants.clampDistance2);
  constants.isFine = needFineSums(lights, constants.unitsPerIrradiance);
  if (!knowsSums_ || !oldMaps_.empty() || constants != constants_ ||
      hasPatches_ != (patches != nullptr) || !std::ranges::equal(lights, lights_) ||
      mapRevisions_ != revisionsOf(patches ? patches->maps() : nullptr) ||
      transferRevisions_ != revisionsOf(patches ? patches->prt() : nullptr))
    return false;
  return std::ranges::equal(tiles_, gbuffer.revision, {}, &Tile::revision);
}

size_t IrradianceAccumulator::changesTo(std::span<const LightRecord> lights) const {
  if (!knowsSums_) return lights.size();
  size_t same = 0;
  const auto now = bySlot(lights), before = bySlot(lights_);
  for (size_t slot = 0; slot < std::min(now.size(), before.size()); ++slot)
    same += now[slot] != nullptr && before[slot] != nullptr && *now[slot] == *before[slot] &&
            !oldMaps_.contains(now[slot]->mapSlot);
  return std::min(lights.size(), lights.size() + lights_.size() - 2 * same);
}

uint32_t IrradianceAccumulator::summed(const GBuffer& gbuffer, size_t tile) const {
  const bool isKnown =
      knowsSums_ && tile < tiles_.size() && tiles_[tile].revision == gbuffer.revision[tile];
  return isKnown ? tiles_[tile].summed : 0;
}

void IrradianceAccumulator::clearPackets(int tile, uint32_t packets) {
  const size_t first = static_cast<size_t>(tile) * kTilePixels;
  for (; packets != 0; packets &= packets - 1) {
    const size_t at = first + static_cast<size_t>(std::countr_zero(packets)) * kLanes;
    for (auto* v : {&sums_.r, &sums_.g, &sums_.b}) std::fill_n(&(*v)[at], kLanes, 0);
    if (!constants_.isFine) continue;
    for (auto* v : {&sums_.fineR, &sums_.fineG, &sums_.fineB}) std::fill_n(&(*v)[at], kLanes, 0);
  }
}

SumCounts IrradianceAccumulator::sumTiles(const Frame& frame, int first, int last) {
  using When = TilePlaces::When;
  SumCounts counts;
  std::vector<LightAdder> kept, begun;
  const PlaceTable* table = hasPatches_ ? &table_ : nullptr;
  const auto newAdder = [&] {
    return LightAdder(frame.gbuffer, table, frame.leftOutBy, constants_, counts);
  };
  const auto addPackets = [&](std::vector<LightAdder>& adders, int tile, uint32_t packets) {
    Tile& t = tiles_[static_cast<size_t>(tile)];
    if ((packets & t.places.hit()) == 0) return false;
    if (adders.empty() || !adders.back().hasRoomFor(packets)) adders.push_back(newAdder());
    adders.back().addPackets(tile, packets, t.places, masksAreCached_ ? &t.lit : nullptr);
    return true;
  };
  for (int i = first; i < last; ++i) {
    Tile& tile = tiles_[static_cast<size_t>(i)];
    clearPackets(i, tile.begun());
    addPackets(begun, i, tile.begun());
    if (!addPackets(kept, i, tile.kept()) || !hasPatches_) continue;
    // Lights that did not change but have another shadow mode here.
    std::vector<int> slots;
    for (const uint32_t row : tile.places.rows())
      for (const int slot : table_.changed(row))
        if (!frame.isChanged[static_cast<size_t>(slot)]) slots.push_back(slot);
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    if (slots.empty()) continue;
    LightAdder here = newAdder();
    here.addPackets(i, tile.kept(), tile.places, masksAreCached_ ? &tile.lit : nullptr);
    for (const int slot : slots) {
      if (static_cast<size_t>(slot) >= frame.slots.size()) continue;
      const LightRecord* light = frame.slots[static_cast<size_t>(slot)];
      if (light == nullptr) continue;
      here.add(*light, Sign::takeAway, When::before);
      here.add(*light, Sign::add, When::after);
    }
    here.finish(sums_);
  }
  // The maps of some lights fit into the L2 cache, but not those of all lights. So each map is
  // loaded once for all tiles of the task.
  const auto bytesOf = [](const LightRecord& light) {
    return sizeof(float) * static_cast<size_t>(light.resolution) * light.resolution;
  };
  const auto addAll = [&](std::vector<LightAdder>& adders,
                          std::span<const LightRecord* const> lights, Sign sign, When when) {
    for (size_t i = 0, end = 0; i < lights.size(); i = end) {
      size_t bytes = 0;
      while (end < lights.size() && (end == i || bytes + bytesOf(*lights[end]) <= kMapBytesAtOnce))
        bytes += bytesOf(*lights[end++]);
      for (LightAdder& tiles : adders) tiles.addAll(lights.subspan(i, end - i), sign, when);
    }
  };
  addAll(kept, frame.taken, Sign::takeAway, When::before);
  addAll(kept, frame.added, Sign::add, When::after);
  for (LightAdder& tiles : kept)
    for (const PlaceTable::Staying& light : frame.staying)
      if (light.isReplaced()) tiles.replace(light);
  addAll(begun, frame.all, Sign::add, When::now);
  for (const std::vector<LightAdder>* adders : {&kept, &begun})
    for (const LightAdder& tiles : *adders) tiles.finish(sums_);
  return counts;
}

// Adds the light map or the radiance transfer, if any, to the light that the pixels sum themselves.
void IrradianceAccumulator::finishTile(const Frame& frame, int tile) {
  const GBuffer& g = frame.gbuffer;
  const size_t first = static_cast<size_t>(tile) * kTilePixels;
  const float unit = 1.0f / constants_.unitsPerIrradiance;
  const Tile& t = tiles_[static_cast<size_t>(tile)];
  for (uint32_t packets = t.wanted; packets != 0; packets &= packets - 1) {
    const size_t packet = first + static_cast<size_t>(std::countr_zero(packets)) * kLanes;
    const auto fine = [&](const std::vector<int32_t>& sums) {
      return constants_.isFine ? &sums[packet] : nullptr;
    };
    scalePacket(&sums_.r[packet], fine(sums_.fineR), unit, &red_[packet]);
    scalePacket(&sums_.g[packet], fine(sums_.fineG), unit, &green_[packet]);
    scalePacket(&sums_.b[packet], fine(sums_.fineB), unit, &blue_[packet]);
  }
  if (!hasMaps_ && !hasTransfer_) return;
  t.places.forEachMapped(t.wanted, [&](size_t packet, uint8_t lanes, const Place& place) {
    const PatchLights& lights = *frame.patches;
    std::array<vec4, kLanes> e;
    if (lights.hasTransfer(place.object, place.leaf)) {
      for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
        const auto lane = static_cast<size_t>(std::countr_zero(rest));
        const size_t i = packet + lane;
        e[lane] = vec4(
            lights.prt()->irradiance(place.object, g.triangle[i], vec3(g.px[i], g.py[i], g.pz[i])),
            0.0f);
      }
    } else {
      LightMaps::Sampler(*lights.maps(), lights.patches(place.object), place.object, place.leaf)
          .irradiance(&g.px[packet], &g.py[packet], &g.pz[packet], e);
    }
    for (uint32_t rest = lanes; rest != 0; rest &= rest - 1) {
      const auto lane = static_cast<size_t>(std::countr_zero(rest));
      const size_t i = packet + lane;
      // The map is interpolated but the subtracted shadows are not: clamped at 0.
      red_[i] = std::max(red_[i] + e[lane].r, 0.0f);
      green_[i] = std::max(green_[i] + e[lane].g, 0.0f);
      blue_[i] = std::max(blue_[i] + e[lane].b, 0.0f);
    }
  });
}

IrradianceAccumulator::HardShadows IrradianceAccumulator::findHardShadows() const {
  HardShadows found{true, std::vector<uint8_t>(red_.size(), 0)};
  if (!hasPatches_) return found;
  std::vector<LightStrength> strengths;
  for (const LightRecord& light : lights_) {
    const bool hasRow = light.slot >= 0 && static_cast<size_t>(light.slot) < table_.slots();
    strengths.push_back({static_cast<LightStrength::Kind>(light.kind), light.normal,
                         std::max({light.intensity.r, light.intensity.g, light.intensity.b}),
                         hasRow ? light.slot : -1});
  }
  const std::vector<int> slots = hardLights(strengths);
  found.hasLights = !slots.empty();
  if (slots.empty()) return found;
  std::vector<uint8_t> isHard(table_.rows(), 0);
  for (const Tile& tile : tiles_)
    for (const uint32_t row : tile.places.rows()) isHard[row] = 1;  // in use
  for (uint32_t row = 0; row < isHard.size(); ++row) {
    if (isHard[row] == 0) continue;
    const ShadowMode* uses = table_.now(row);
    isHard[row] = std::any_of(slots.begin(), slots.end(),
                              [&](int slot) { return readsShadowMap(uses[slot]); });
  }
  for (const Tile& tile : tiles_)
    tile.places.forEachRow([&](size_t packet, uint8_t lanes, uint32_t row) {
      if (isHard[row] == 0) return;
      for (size_t lane = 0; lane < kLanes; ++lane)
        if ((lanes >> lane & 1) != 0) found.at[packet + lane] = 1;
    });
  return found;
}

size_t IrradianceAccumulator::bytes() const {
  size_t bytes = sums_.r.size() * 3 * (sizeof(int32_t) + sizeof(float)) +
                 sums_.fineR.size() * 3 * sizeof(int32_t) + table_.bytes();
  for (const Tile& tile : tiles_) bytes += tile.lit.bytes();
  for (const auto& [slot, old] : oldMaps_) bytes += old.texels.size() * sizeof(float);
  return bytes;
}

}  // namespace lamplighter::cpu
