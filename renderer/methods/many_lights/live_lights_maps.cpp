// Which of the shown VPLs have shadow maps, and of which size.
#include <algorithm>

#include "renderer/methods/many_lights/live_lights.h"
#include "renderer/scene/vpl.h"
#include "renderer/visibility/hard_shadow_lights.h"
#include "renderer/visibility/light_clusters.h"

namespace lamplighter {

// A rank for each entry, such that the lowest ranks are spread over all lights: VPLs without maps
// need neighbours that have one. The ranks depend only on the lights, so a moving camera does not
// exchange all maps.
std::vector<uint32_t> LiveLights::spreadTurns() const {
  std::vector<shared::Vpl> vpls;
  vpls.reserve(entries_.size());
  for (const Entry& e : entries_) vpls.push_back(e.isLive ? e.current : e.wanted.vpl);
  const std::vector<int> order = clusterLights(vpls).order;
  std::vector<uint32_t> turns(entries_.size(), 0);
  for (uint32_t i = 0; i < order.size(); ++i) {
    uint32_t reversed = 0;
    for (uint32_t bit = 0; bit < 32; ++bit) reversed |= (i >> bit & 1u) << (31 - bit);
    turns[static_cast<size_t>(order[i])] = reversed;
  }
  return turns;
}

int LiveLights::updateMaps(ManyLightsKernels& kernels, const MapLimits& limits) {
  ++calls_;
  // A stale VPL waits for its refresh, but keeps its map.
  std::vector<Entry*> wants;
  for (Entry& e : entries_) {
    e.lacksMap = e.hasNoRoom = false;
    if (!e.isLive || !needsMap(e) || ((e.moves() || e.mapIsStale) && !e.hasMap)) continue;
    wants.push_back(&e);
    lastNeeded_[static_cast<size_t>(e.slot)] = calls_;
  }
  const auto room = static_cast<size_t>(std::max(limits.held, 0));
  if (wants.size() > std::min(room, static_cast<size_t>(std::max(limits.rendered, 0)))) {
    const std::vector<uint32_t> turns = spreadTurns();
    std::sort(wants.begin(), wants.end(), [&](const Entry* a, const Entry* b) {
      return turns[static_cast<size_t>(a - entries_.data())] <
             turns[static_cast<size_t>(b - entries_.data())];
    });
  }
  for (size_t i = room; i < wants.size(); ++i) wants[i]->hasNoRoom = true;
  wants.resize(std::min(wants.size(), room));

  std::vector<shared::Vpl> maps;
  std::vector<uint8_t> keeps(holds_.size(), 0), mayKeep(holds_.size(), 0);
  for (const Entry& e : entries_)
    if (e.hasMap && !e.hasNoRoom) mayKeep[static_cast<size_t>(e.slot)] = 1;
  for (Entry* e : wants) {
    e->lacksMap = !e->hasMap;
    if (!e->hasMap && maps.size() < static_cast<size_t>(std::max(limits.rendered, 0)))
      maps.push_back(e->current);
    else if (!e->hasMap)
      continue;
    keeps[static_cast<size_t>(e->slot)] = 1;
  }
  // First drops the maps of VPLs that no longer exist; then, if memory is short, those needed least
  // recently.
  std::vector<int> dropped, spare;
  size_t held = static_cast<size_t>(std::count(keeps.begin(), keeps.end(), 1));
  for (size_t slot = 0; slot < holds_.size(); ++slot) {
    if (holds_[slot] == 0 || keeps[slot] != 0) continue;
    (mayKeep[slot] != 0 ? spare : dropped).push_back(static_cast<int>(slot));
  }
  std::stable_sort(spare.begin(), spare.end(), [&](int a, int b) {
    return lastNeeded_[static_cast<size_t>(a)] > lastNeeded_[static_cast<size_t>(b)];
  });
  for (const int slot : spare) {
    if (held < room)
      ++held;
    else
      dropped.push_back(slot);
  }
  for (const int slot : dropped) holds_[static_cast<size_t>(slot)] = 0;
  for (const shared::Vpl& vpl : maps) holds_[static_cast<size_t>(vpl.slot)] = 1;
  for (Entry& e : entries_) {
    const bool hasMap = e.hasMap;
    e.hasMap = holds_[static_cast<size_t>(e.slot)] != 0 && (e.hasMap || e.lacksMap);
    if (e.hasMap) e.lacksMap = false;
    if (!hasMap) e.isFine = false;
    changed_ = changed_ || e.hasMap != hasMap;
  }
  if (!dropped.empty()) kernels.dropShadowMaps(dropped);
  if (!maps.empty()) kernels.renderShadowMaps(maps);
  // If only VPLs with maps are shown, the sums change, too.
  if (onlyMapped_)
    tableIsCurrent_ = false;
  else if (tableIsCurrent_)
    setMapColumns();
  return static_cast<int>(maps.size());
}

int LiveLights::missingSunTiles() const {
  return static_cast<int>(std::ranges::count_if(entries_, [](const Entry& e) {
    return e.isWanted && !e.isLive && e.wanted.vpl.position.w == shared::kVplDirectional;
  }));
}

int LiveLights::coarse() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [&](const Entry& e) { return isCoarse(e); }));
}

int LiveLights::sharpenMaps(ManyLightsKernels& kernels, int most) {
  return sharpen(kernels, most, [](const Entry&) { return true; });
}

int LiveLights::sharpenHardLights(ManyLightsKernels& kernels, int most) {
  std::vector<LightStrength> strengths;
  for (const Entry& e : entries_)
    if (isShown(e)) strengths.push_back(strengthOf(e.current, e.slot));
  const std::vector<int> hard = hardLights(strengths);
  const int rendered = hard.empty() ? 0 : sharpen(kernels, most, [&](const Entry& e) {
    return isShown(e) && !e.moves() && !e.mapIsStale &&
           e.current.position.w != shared::kVplDirectional &&
           std::find(hard.begin(), hard.end(), e.slot) != hard.end();
  });
  changed_ = changed_ || rendered > 0;
  return rendered;
}

template <typename IsMeant>
int LiveLights::sharpen(ManyLightsKernels& kernels, int most, const IsMeant& isMeant) {
  std::vector<Entry*> next;
  for (Entry& e : entries_)
    if (isCoarse(e) && isMeant(e)) next.push_back(&e);
  std::stable_sort(next.begin(), next.end(), [](const Entry* a, const Entry* b) {
    return brightness(a->current) > brightness(b->current);
  });
  next.resize(std::min(next.size(), static_cast<size_t>(std::max(most, 0))));
  if (next.empty()) return 0;
  std::vector<shared::Vpl> maps;
  for (Entry* e : next) {
    maps.push_back(e->current);
    e->isFine = true;
  }
  isSharper_ = true;
  kernels.renderShadowMaps(maps, MapSize::fine);
  return static_cast<int>(maps.size());
}

void LiveLights::showOnlyMapped(bool onlyMapped) {
  tableIsCurrent_ = false;
  changed_ = changed_ || onlyMapped != onlyMapped_;
  onlyMapped_ = onlyMapped;
}

int LiveLights::withoutMap() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return e.hasNoRoom; }));
}

}  // namespace lamplighter
