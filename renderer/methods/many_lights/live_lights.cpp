#include "renderer/methods/many_lights/live_lights.h"

#include <algorithm>

namespace lamplighter {
namespace {

float brightness(const shared::Vpl& vpl) {
  return std::max({vpl.intensity.r, vpl.intensity.g, vpl.intensity.b});
}

bool samePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

// Slots are reserved with room to spare, so that a VPL more or less does not lose all maps; when
// they are lost, refresh() has the same frame to make some anew and shown() keeps the brightness.
void LiveLights::fitSlots(size_t wanted) {
  constexpr size_t kStep = 32;
  const int fitting = static_cast<int>((wanted + kStep - 1) / kStep * kStep);
  if (fitting <= slots_ && 4 * fitting >= slots_) return;
  slots_ = fitting;
  loseMaps();
  for (Entry& e : entries_) e.slot = -1;
}

void LiveLights::want(std::vector<SceneVpl> wanted) {
  fitSlots(wanted.size());
  std::map<VplId, size_t> before;
  for (size_t i = 0; i < entries_.size(); ++i) before.emplace(entries_[i].wanted.id, i);
  std::map<VplId, float> brightnessOfSet;
  for (const SceneVpl& w : wanted) brightnessOfSet[w.id.set()] += brightness(w.vpl);

  std::vector<Entry> next;
  next.reserve(wanted.size());
  std::vector<bool> slotTaken(static_cast<size_t>(slots_), false);
  for (SceneVpl& w : wanted) {
    Entry& e = next.emplace_back();
    const auto it = before.find(w.id);
    if (it != before.end()) {
      e = entries_[it->second];
      before.erase(it);  // an id is used once
    }
    const float whole = brightnessOfSet[w.id.set()];
    e.share = whole > 0.0f ? brightness(w.vpl) / whole : 0.0f;
    e.wanted = std::move(w);
    if (e.isLive) {
      e.isStale = e.isStale || !samePlace(e.current, e.wanted.vpl);
      const vec4 intensity(vec3(e.wanted.vpl.intensity), e.current.intensity.w);
      changed_ = changed_ || e.current.intensity != intensity;
      e.current.intensity = intensity;
    }
    if (e.slot >= 0) slotTaken[e.slot] = true;
  }
  changed_ = changed_ || !before.empty();
  size_t free = 0;
  for (Entry& e : next) {
    if (e.slot >= 0) continue;
    while (slotTaken[free]) ++free;
    slotTaken[free] = true;
    e.slot = static_cast<int>(free);
  }
  entries_ = std::move(next);
}

int LiveLights::markStale(std::span<const MoverFinder::Mover> movers,
                          const std::function<bool(const shared::Vpl&)>& spared) {
  int count = 0;
  for (Entry& e : entries_) {
    if (e.isStale) continue;
    const bool sees = std::any_of(movers.begin(), movers.end(), [&](const MoverFinder::Mover& m) {
      return seesMover(e.current, m.before, m.after);
    });
    if (!sees) continue;
    e.isStale = !(spared && spared(e.current));
    count += !e.isStale;
  }
  return count;
}

std::vector<bool> LiveLights::upToDate() const {
  std::vector<bool> bySlot(static_cast<size_t>(slots_), false);
  for (const Entry& e : entries_)
    if (e.isLive && !e.isStale) bySlot[static_cast<size_t>(e.slot)] = true;
  return bySlot;
}

void LiveLights::loseMaps() {
  for (Entry& e : entries_) {
    e.isLive = false;
    e.isStale = true;
  }
  changed_ = true;
}

int LiveLights::refresh(Backend& backend, const RefreshBudget& budget, const RefreshWork& moved,
                        const RefreshWork& stale) {
  std::vector<size_t> waiting;
  std::vector<RefreshCandidate> candidates;
  for (size_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    if (!e.isStale) continue;
    waiting.push_back(i);
    const bool stays = e.isLive && samePlace(e.current, e.wanted.vpl);
    candidates.push_back({brightness(e.wanted.vpl), ++e.framesWaiting, stays ? stale : moved});
  }
  std::vector<shared::Vpl> maps;
  for (const size_t chosen : chooseRefreshes(candidates, budget)) {
    Entry& e = entries_[waiting[chosen]];
    e.current = e.wanted.vpl;
    e.current.intensity.w = static_cast<float>(e.slot);
    e.isLive = true;
    e.isStale = false;
    e.framesWaiting = 0;
    maps.push_back(e.current);
  }
  if (maps.empty()) return 0;
  backend.renderShadowMaps(maps);
  changed_ = true;
  return static_cast<int>(maps.size());
}

std::vector<shared::Vpl> LiveLights::shown() const {
  struct Set {
    float share = 0.0f;
    bool isWhole = true;
  };
  std::map<VplId, Set> sets;
  for (const Entry& e : entries_) {
    Set& set = sets[e.wanted.id.set()];
    if (e.isLive) {
      set.share += e.share;
    } else if (e.wanted.isSample) {
      set.isWhole = false;
    }
  }
  std::vector<shared::Vpl> vpls;
  for (const Entry& e : entries_) {
    if (!e.isLive) continue;
    shared::Vpl& vpl = vpls.emplace_back(e.current);
    const Set& set = sets[e.wanted.id.set()];
    if (set.isWhole || !(set.share > 0.0f)) continue;
    vpl.intensity = vec4(vec3(vpl.intensity) / set.share, vpl.intensity.w);
  }
  return vpls;
}

std::vector<InspectedLight> LiveLights::inspect() const {
  std::vector<InspectedLight> lights;
  lights.reserve(entries_.size());
  for (const Entry& e : entries_)
    lights.push_back({e.isLive ? e.current : e.wanted.vpl, e.wanted.id, e.slot, e.isLive, e.isStale,
                      e.framesWaiting});
  return lights;
}

int LiveLights::pending() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return e.isStale; }));
}

int LiveLights::live() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return e.isLive; }));
}

int LiveLights::oldestFrames() const {
  int oldest = 0;
  for (const Entry& e : entries_) {
    if (e.isStale) oldest = std::max(oldest, e.framesWaiting);
  }
  return oldest;
}

}  // namespace lamplighter
