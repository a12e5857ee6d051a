#include "renderer/methods/many_lights/live_lights.h"

#include <algorithm>

namespace lamplighter {
namespace {

float brightness(const shared::Vpl& vpl) {
  return std::max({vpl.intensity.r, vpl.intensity.g, vpl.intensity.b});
}

// Less than this share of a set's brightness may be missing, or of a VPL's be wrong, until its turn
// comes: nobody sees it, and to put it right at once would touch all of them.
constexpr float kSmallShare = 0.05f;

bool isNearly(const vec4& a, const vec4& b) {
  const vec3 difference = glm::abs(vec3(a) - vec3(b));
  const vec3 most = kSmallShare * glm::max(vec3(a), vec3(b));
  return glm::all(glm::lessThanEqual(difference, most));
}

bool samePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

void LiveLights::takeBrightness(Entry& e) {
  e.current.intensity = vec4(vec3(e.wanted.vpl.intensity), e.current.intensity.w);
}

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
    const bool stays = e.isLive && samePlace(e.current, e.wanted.vpl);
    e.mapIsStale = e.mapIsStale || !stays;
    // What it stands for hangs on its neighbours, and no map or kept sum hangs on that.
    if (stays && e.current.footprint != e.wanted.vpl.footprint) {
      e.current.footprint = e.wanted.vpl.footprint;
      changed_ = true;
    }
    if (stays && !isNearly(e.current.intensity, e.wanted.vpl.intensity)) {
      takeBrightness(e);
      changed_ = true;
    }
    e.isOff = stays && vec3(e.current.intensity) != vec3(e.wanted.vpl.intensity);
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
    if (e.mapIsStale) continue;
    const bool sees = std::any_of(movers.begin(), movers.end(), [&](const MoverFinder::Mover& m) {
      return seesMover(e.current, m.before, m.after);
    });
    if (!sees) continue;
    e.mapIsStale = !(spared && spared(e.current));
    count += !e.mapIsStale;
  }
  return count;
}

std::vector<bool> LiveLights::upToDate() const {
  std::vector<bool> bySlot(static_cast<size_t>(slots_), false);
  for (const Entry& e : entries_)
    if (e.isLive && !e.mapIsStale) bySlot[static_cast<size_t>(e.slot)] = true;
  return bySlot;
}

void LiveLights::loseMaps() {
  for (Entry& e : entries_) {
    e.isLive = false;
    e.mapIsStale = true;
    e.isOff = false;
  }
  changed_ = true;
}

int LiveLights::refresh(Backend& backend, const RefreshBudget& budget, const RefreshWork& moved,
                        const RefreshWork& stale) {
  std::vector<size_t> waiting;
  std::vector<RefreshCandidate> candidates;
  for (size_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    if (!e.isPending()) continue;
    waiting.push_back(i);
    const bool stays = e.isLive && samePlace(e.current, e.wanted.vpl);
    const RefreshWork work = !e.mapIsStale ? RefreshWork() : stays ? stale : moved;
    candidates.push_back({brightness(e.wanted.vpl), ++e.framesWaiting, work});
  }
  std::vector<shared::Vpl> maps;
  for (const size_t chosen : chooseRefreshes(candidates, budget)) {
    Entry& e = entries_[waiting[chosen]];
    changed_ = true;
    e.framesWaiting = 0;
    e.isOff = false;
    if (!e.mapIsStale) {
      takeBrightness(e);
      continue;
    }
    e.current = e.wanted.vpl;
    e.current.intensity.w = static_cast<float>(e.slot);
    e.isLive = true;
    e.mapIsStale = false;
    maps.push_back(e.current);
  }
  if (!maps.empty()) backend.renderShadowMaps(maps);
  return static_cast<int>(maps.size());
}

std::vector<shared::Vpl> LiveLights::shown() const {
  struct Set {
    float share = 0.0f;
    float missing = 0.0f;  // of samples that are to come
  };
  std::map<VplId, Set> sets;
  for (const Entry& e : entries_) {
    Set& set = sets[e.wanted.id.set()];
    if (e.isLive) {
      set.share += e.share;
    } else if (e.wanted.isSample) {
      set.missing += e.share;
    }
  }
  std::vector<shared::Vpl> vpls;
  for (const Entry& e : entries_) {
    if (!e.isLive) continue;
    shared::Vpl& vpl = vpls.emplace_back(e.current);
    const Set& set = sets[e.wanted.id.set()];
    if (set.missing <= kSmallShare || !(set.share > 0.0f)) continue;
    vpl.intensity = vec4(vec3(vpl.intensity) / set.share, vpl.intensity.w);
  }
  return vpls;
}

std::vector<InspectedLight> LiveLights::inspect() const {
  std::vector<InspectedLight> lights;
  lights.reserve(entries_.size());
  for (const Entry& e : entries_)
    lights.push_back({e.isLive ? e.current : e.wanted.vpl, e.wanted.id, e.slot, e.isLive,
                      e.isPending(), e.framesWaiting});
  return lights;
}

int LiveLights::pending() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                        [](const Entry& e) { return e.isPending(); }));
}

int LiveLights::live() const {
  return static_cast<int>(
      std::count_if(entries_.begin(), entries_.end(), [](const Entry& e) { return e.isLive; }));
}

int LiveLights::oldestFrames() const {
  int oldest = 0;
  for (const Entry& e : entries_) {
    if (e.isPending()) oldest = std::max(oldest, e.framesWaiting);
  }
  return oldest;
}

}  // namespace lamplighter
