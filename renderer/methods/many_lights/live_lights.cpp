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

// However little of a map is out of date, it waits no more than so much longer than one that all
// is of.
constexpr float kLeastUrgency = 0.1f;

bool samePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

void LiveLights::takeBrightness(Entry& e) {
  e.current.intensity = vec4(vec3(e.wanted.vpl.intensity), e.current.intensity.w);
}

bool LiveLights::Entry::moves() const {
  return !isWanted || !isLive || !samePlace(current, wanted.vpl);
}

// Slots are reserved with room to spare, so that a VPL more or less does not lose all maps, and
// paths that are being replaced have room for what they were; when maps are lost, refresh() has the
// same frame to make some anew and shown() keeps the brightness.
void LiveLights::fitSlots(size_t wanted) {
  constexpr size_t kStep = 32;
  const int fitting = static_cast<int>((wanted + wanted / 8 + kStep - 1) / kStep * kStep);
  if (static_cast<int>(wanted) <= slots_ && 4 * fitting >= slots_) return;
  slots_ = fitting;
  loseMaps();
  for (Entry& e : entries_) e.slot = -1;
}

void LiveLights::want(std::vector<SceneVpl> wanted, std::span<const VplId> paths) {
  fitSlots(wanted.size());
  std::map<VplId, size_t> before;
  for (size_t i = 0; i < entries_.size(); ++i) before.emplace(entries_[i].wanted.id, i);
  std::map<VplId, float> brightnessOfSet;
  // Paths that left nothing are shown as they are.
  std::map<VplId, bool> pathIsShown;
  for (const VplId& path : paths) pathIsShown.emplace(path, true);
  for (const SceneVpl& w : wanted) {
    brightnessOfSet[w.id.set()] += brightness(w.vpl);
    if (w.id.bounce > 0) pathIsShown[w.id.path()] = false;
  }
  for (auto& [path, isShown] : pathIsShown) {
    const auto it = pathIsShown_.find(path);
    isShown = isShown || (it != pathIsShown_.end() && it->second);
  }
  pathIsShown_ = std::move(pathIsShown);

  std::vector<Entry> next;
  next.reserve(wanted.size());
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
    e.isWanted = true;
    const bool stays = !e.moves();
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
  }
  keepReplaced(before, next);
  changed_ = changed_ || next.size() - wanted.size() != before.size();
  entries_ = std::move(next);
  giveSlots();
}

// Of VPLs that are wanted no more, those whose path is: they stay until its turn.
void LiveLights::keepReplaced(const std::map<VplId, size_t>& gone, std::vector<Entry>& next) const {
  for (const auto& [id, index] : gone) {
    const Entry& e = entries_[index];
    if (!e.isLive || id.bounce == 0 || !pathIsShown_.contains(id.path())) continue;
    next.push_back(e);
    next.back().isWanted = false;
    next.back().share = 0.0f;
  }
}

// To those that are wanted first; what is not gives up its own where there are too few.
void LiveLights::giveSlots() {
  std::vector<bool> isTaken(static_cast<size_t>(slots_), false);
  size_t without = 0;
  for (const Entry& e : entries_) {
    if (e.slot >= 0) isTaken[static_cast<size_t>(e.slot)] = true;
    without += e.slot < 0;
  }
  auto left = static_cast<size_t>(std::count(isTaken.begin(), isTaken.end(), false));
  while (without > left && !entries_.empty() && !entries_.back().isWanted) {
    isTaken[static_cast<size_t>(entries_.back().slot)] = false;
    entries_.pop_back();
    changed_ = true;
    ++left;
  }
  size_t free = 0;
  for (Entry& e : entries_) {
    if (e.slot >= 0) continue;
    while (isTaken[free]) ++free;
    isTaken[free] = true;
    e.slot = static_cast<int>(free);
  }
}

int LiveLights::markStale(std::span<const MoverFinder::Mover> movers,
                          const std::function<bool(const shared::Vpl&)>& spared) {
  int count = 0;
  for (Entry& e : entries_) {
    if (!e.isLive) continue;
    bool sees = false;
    for (const MoverFinder::Mover& m : movers) {
      if (!seesMover(e.current, m.before, m.after)) continue;
      sees = true;
      e.staleShare += hiddenShare(e.current, m.before) + hiddenShare(e.current, m.after);
    }
    if (!sees || e.mapIsStale) continue;
    // One that moves waits as it is; its column does too.
    e.mapIsStale = e.moves() || !(spared && spared(e.current));
    count += !e.mapIsStale;
  }
  return count;
}

std::vector<bool> LiveLights::upToDate() const {
  std::vector<bool> bySlot(static_cast<size_t>(slots_), false);
  for (const Entry& e : entries_)
    if (!e.moves() && !e.mapIsStale) bySlot[static_cast<size_t>(e.slot)] = true;
  return bySlot;
}

void LiveLights::loseMaps() {
  std::erase_if(entries_, [](const Entry& e) { return !e.isWanted; });
  for (Entry& e : entries_) {
    e.isLive = e.mapIsStale = e.isOff = false;
    e.staleShare = 0.0f;
    if (e.wanted.id.bounce > 0) pathIsShown_[e.wanted.id.path()] = false;
  }
  changed_ = true;
}

std::vector<LiveLights::Group> LiveLights::pendingGroups(const RefreshWork& moved,
                                                         const RefreshWork& stale) {
  std::vector<Group> groups;
  std::map<VplId, size_t> ofPath;  // that changes
  for (const Entry& e : entries_) {
    const VplId& id = e.wanted.id;
    if (id.bounce > 0 && e.moves() && ofPath.emplace(id.path(), groups.size()).second)
      groups.emplace_back();
  }
  for (size_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    const auto path = e.wanted.id.bounce > 0 ? ofPath.find(e.wanted.id.path()) : ofPath.end();
    const bool isOfPath = path != ofPath.end();
    if (!isOfPath && !e.isPending()) continue;
    Group& group = isOfPath ? groups[path->second] : groups.emplace_back();
    group.entries.push_back(i);
    RefreshCandidate& c = group.candidate;
    const float urgency =
        e.moves() || e.isOff ? 1.0f : std::clamp(e.staleShare, kLeastUrgency, 1.0f);
    c.brightness =
        std::max(c.brightness, urgency * brightness(e.isWanted ? e.wanted.vpl : e.current));
    c.framesWaiting = std::max(c.framesWaiting, ++e.framesWaiting);
    if (!e.isWanted) continue;
    if (e.moves() || e.mapIsStale) c.work += e.moves() ? moved : stale;
    ++c.vpls;
  }
  pairUp(groups);
  return groups;
}

// Paths that go wait for those of their light that come, so that it gets no darker in between.
void LiveLights::pairUp(std::vector<Group>& groups) const {
  struct Exchange {
    std::vector<Group*> going, coming;
  };
  std::map<VplId, Exchange> ofLight;
  for (Group& group : groups) {
    const VplId& id = entries_[group.entries.front()].wanted.id;
    if (id.bounce == 0) continue;
    const auto any = [&](bool Entry::*is) {
      return std::any_of(group.entries.begin(), group.entries.end(),
                         [&](size_t i) { return entries_[i].*is; });
    };
    Exchange& exchange = ofLight[{id.light, id.emitter, 0, 0}];
    if (!any(&Entry::isWanted)) {
      exchange.going.push_back(&group);
    } else if (!any(&Entry::isLive)) {
      exchange.coming.push_back(&group);
    }
  }
  for (auto& [light, exchange] : ofLight) {
    for (size_t i = 0; i < std::min(exchange.going.size(), exchange.coming.size()); ++i) {
      std::vector<size_t>& gone = exchange.going[i]->entries;
      std::vector<size_t>& all = exchange.coming[i]->entries;
      all.insert(all.end(), gone.begin(), gone.end());
      gone.clear();
    }
  }
  std::erase_if(groups, [](const Group& group) { return group.entries.empty(); });
}

int LiveLights::refresh(Backend& backend, const RefreshBudget& budget, const RefreshWork& moved,
                        const RefreshWork& stale) {
  const std::vector<Group> groups = pendingGroups(moved, stale);
  std::vector<RefreshCandidate> candidates;
  for (const Group& group : groups) candidates.push_back(group.candidate);
  std::vector<shared::Vpl> maps;
  for (const size_t chosen : chooseRefreshes(candidates, budget)) {
    for (const size_t index : groups[chosen].entries) {
      Entry& e = entries_[index];
      changed_ = true;
      e.framesWaiting = 0;
      e.isOff = false;
      if (!e.isWanted) {
        e.isLive = false;
        continue;
      }
      if (e.wanted.id.bounce > 0) pathIsShown_[e.wanted.id.path()] = true;
      if (!e.moves() && !e.mapIsStale) {
        takeBrightness(e);
        continue;
      }
      e.current = e.wanted.vpl;
      e.current.intensity.w = static_cast<float>(e.slot);
      e.isLive = true;
      e.mapIsStale = false;
      e.staleShare = 0.0f;
      maps.push_back(e.current);
    }
  }
  std::erase_if(entries_, [](const Entry& e) { return !e.isWanted && !e.isLive; });
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
    const VplId& id = e.wanted.id;
    Set& set = sets[id.set()];
    // A path that is shown as it was stands for what it will be.
    if (e.isLive || (id.bounce > 0 && pathIsShown_.at(id.path()))) {
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
