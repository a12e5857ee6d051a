#include "renderer/methods/many_lights/live_lights.h"

#include <algorithm>

#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

// A set may lack less than this share of its brightness, and a VPL may be wrong by less than this
// share, until its turn comes: it is invisible, and an immediate correction would affect all VPLs.
constexpr float kSmallShare = 0.05f;

bool isNearly(const vec3& a, const vec3& b) {
  const vec3 difference = glm::abs(a - b);
  const vec3 most = kSmallShare * glm::max(a, b);
  return glm::all(glm::lessThanEqual(difference, most));
}

// Lower bound of the urgency of a partly stale map, relative to a completely stale one; it bounds
// the waiting time.
constexpr float kLeastUrgency = 0.1f;

bool samePlace(const shared::Vpl& a, const shared::Vpl& b) {
  return a.position == b.position && a.normal == b.normal && a.tangent == b.tangent;
}

}  // namespace

void LiveLights::takeBrightness(Entry& e) { e.current.intensity = e.wanted.vpl.intensity; }

bool LiveLights::Entry::moves() const {
  return !isWanted || !isLive || !samePlace(current, wanted.vpl);
}

// Reserves spare slots, so that one VPL more does not lose all maps, and paths that are being
// replaced have room for their old VPLs. If maps are lost, refresh() renders some again in the same
// frame, and shown() keeps the brightness.
void LiveLights::fitSlots(size_t wanted) {
  constexpr size_t kStep = 32;
  const int fitting = static_cast<int>((wanted + wanted / 8 + kStep - 1) / kStep * kStep);
  if (static_cast<int>(wanted) <= slots_ && 4 * fitting >= slots_) return;
  slots_ = fitting;
  loseMaps();
  holds_.assign(static_cast<size_t>(slots_), 0);
  lastNeeded_.assign(static_cast<size_t>(slots_), 0);
  for (Entry& e : entries_) e.slot = -1;
}

void LiveLights::want(std::vector<SceneVpl> wanted, std::span<const VplId> paths) {
  tableIsCurrent_ = false;
  fitSlots(wanted.size());
  std::map<VplId, size_t> before;
  for (size_t i = 0; i < entries_.size(); ++i) before.emplace(entries_[i].wanted.id, i);
  std::map<VplId, float> brightnessOfSet;
  // Paths without VPLs count as shown.
  std::vector<ShownPath> shown;
  shown.reserve(paths.size() + wanted.size());
  for (const VplId& path : paths) shown.push_back({path, true});
  for (const SceneVpl& w : wanted) {
    brightnessOfSet[w.id.set()] += brightness(w.vpl);
    if (w.id.bounce > 0) shown.push_back({w.id.path(), false});
  }
  takeShown(std::move(shown));

  std::vector<Entry> next;
  next.reserve(wanted.size());
  for (SceneVpl& w : wanted) {
    Entry& e = next.emplace_back();
    const auto it = before.find(w.id);
    if (it != before.end()) {
      e = entries_[it->second];
      before.erase(it);  // each id is used once
    }
    const float whole = brightnessOfSet[w.id.set()];
    e.share = whole > 0.0f ? brightness(w.vpl) / whole : 0.0f;
    e.wanted = std::move(w);
    e.isWanted = true;
    e.lacksMap = false;  // until updateMaps() sets it
    const bool stays = !e.moves();
    // Links of lights are renumbered when one of them changes.
    if (e.current.footprint.y != e.wanted.vpl.footprint.y) {
      e.current.footprint.y = e.wanted.vpl.footprint.y;
      changed_ = changed_ || e.isLive;
    }
    // The footprint depends on the neighbours, and no map or kept sum depends on it.
    if (stays && e.current.footprint != e.wanted.vpl.footprint) {
      e.current.footprint = e.wanted.vpl.footprint;
      changed_ = true;
    }
    if (stays && !isNearly(e.current.intensity, e.wanted.vpl.intensity)) {
      takeBrightness(e);
      changed_ = true;
    }
    e.isOff = stays && e.current.intensity != e.wanted.vpl.intensity;
  }
  keepReplaced(before, next);
  changed_ = changed_ || next.size() - wanted.size() != before.size();
  entries_ = std::move(next);
  giveSlots();
}

// The paths of a new set: those that have VPLs are shown if they were shown before.
void LiveLights::takeShown(std::vector<ShownPath> shown) {
  // Among equal paths, the one with VPLs comes first.
  std::sort(shown.begin(), shown.end(), [](const ShownPath& a, const ShownPath& b) {
    return a.path != b.path ? a.path < b.path : !a.isShown && b.isShown;
  });
  shown.erase(std::unique(shown.begin(), shown.end(),
                          [](const ShownPath& a, const ShownPath& b) { return a.path == b.path; }),
              shown.end());
  auto old = pathIsShown_.begin();  // both have the same order
  for (ShownPath& s : shown) {
    while (old != pathIsShown_.end() && old->path < s.path) ++old;
    s.isShown = s.isShown || (old != pathIsShown_.end() && old->path == s.path && old->isShown);
  }
  pathIsShown_ = std::move(shown);
}

size_t LiveLights::indexOfShown(const VplId& path) const {
  const auto it = std::lower_bound(pathIsShown_.begin(), pathIsShown_.end(), path,
                                   [](const ShownPath& s, const VplId& id) { return s.path < id; });
  const bool isFound = it != pathIsShown_.end() && it->path == path;
  return isFound ? static_cast<size_t>(it - pathIsShown_.begin()) : pathIsShown_.size();
}

void LiveLights::setShown(const VplId& path, bool isShown) {
  const size_t i = indexOfShown(path);
  if (i < pathIsShown_.size()) pathIsShown_[i].isShown = isShown;
}

void LiveLights::setGains(LightGains gains) {
  if (gains == gains_) return;
  gains_ = std::move(gains);
  tableIsCurrent_ = false;
  gainsChanged_ = true;
}

// Keeps the unwanted VPLs of paths that are still wanted, until the turn of their path.
void LiveLights::keepReplaced(const std::map<VplId, size_t>& gone, std::vector<Entry>& next) const {
  for (const auto& [id, index] : gone) {
    const Entry& e = entries_[index];
    if (!e.isLive || id.bounce == 0 || !isKnown(id.path())) continue;
    next.push_back(e);
    next.back().isWanted = false;
    next.back().share = 0.0f;
  }
}

// Assigns slots to wanted VPLs first; unwanted ones lose their slots if there are too few.
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
  tableIsCurrent_ = false;
  int count = 0;
  for (Entry& e : entries_) {
    if (!e.isLive) continue;
    bool sees = false;
    for (const MoverFinder::Mover& m : movers) {
      if (!seesMover(e.current, m.before, m.after)) continue;
      sees = true;
      e.staleShare += hiddenShare(e.current, m.before) + hiddenShare(e.current, m.after);
    }
    if (e.isOfLamp() &&
        std::ranges::find(movers, e.wanted.id.light, &MoverFinder::Mover::node) != movers.end())
      e.isMisplaced = e.movesNow = true;
    if (!sees || e.mapIsStale) continue;
    // A VPL that must move waits with its old map and its old database column.
    e.mapIsStale = e.moves() || !(spared && spared(e.current));
    count += !e.mapIsStale;
  }
  return count;
}

void LiveLights::loseMaps() {
  tableIsCurrent_ = false;
  std::erase_if(entries_, [](const Entry& e) { return !e.isWanted; });
  for (Entry& e : entries_) {
    e.isLive = e.mapIsStale = e.isOff = e.isMisplaced = e.movesNow = e.isHidden = false;
    e.staleShare = 0.0f;
    if (e.wanted.id.bounce > 0) setShown(e.wanted.id.path(), false);
    e.hasMap = e.isFine = e.lacksMap = e.hasNoRoom = false;
  }
  std::fill(holds_.begin(), holds_.end(), uint8_t{0});
  changed_ = true;
}

// Lamps of which no sample is shown yet, with their brightness. Their samples are shared out among
// them in proportion to it (the method of D'Hondt), so that a new scene has light of each.
std::map<VplId, LiveLights::UnseenLamp> LiveLights::unseenLamps() const {
  std::map<VplId, UnseenLamp> lamps;
  for (const Entry& e : entries_)
    if (e.isWanted && !e.isLive && e.isOfLamp())
      lamps[e.wanted.id.set()].brightness += brightness(e.wanted.vpl);
  if (lamps.empty()) return lamps;
  for (const Entry& e : entries_)
    if (e.isLive) lamps.erase(e.wanted.id.set());
  return lamps;
}

std::vector<LiveLights::Group> LiveLights::pendingGroups(const RefreshWork& moved,
                                                         const RefreshWork& stale) {
  std::vector<Group> groups;
  std::map<VplId, size_t> ofPath;  // group of each changing path
  for (const Entry& e : entries_) {
    const VplId& id = e.wanted.id;
    if (id.bounce > 0 && e.moves() && ofPath.emplace(id.path(), groups.size()).second)
      groups.emplace_back();
  }
  std::map<VplId, UnseenLamp> unseen = unseenLamps();
  for (size_t i = 0; i < entries_.size(); ++i) {
    Entry& e = entries_[i];
    const auto path = e.wanted.id.bounce > 0 ? ofPath.find(e.wanted.id.path()) : ofPath.end();
    const bool isOfPath = path != ofPath.end();
    if (!isOfPath && !e.mustRefresh()) continue;
    if (e.waitsForRest) continue;
    Group& group = isOfPath ? groups[path->second] : groups.emplace_back();
    group.entries.push_back(i);
    RefreshCandidate& c = group.candidate;
    const float urgency =
        e.moves() || e.isOff ? 1.0f : std::clamp(e.staleShare, kLeastUrgency, 1.0f);
    c.isFirst = e.follows;
    c.brightness =
        std::max(c.brightness, urgency * brightness(e.isWanted ? e.wanted.vpl : e.current));
    if (const auto lamp = unseen.find(e.wanted.id.set()); lamp != unseen.end())
      c.brightness = lamp->second.brightness / static_cast<float>(++lamp->second.samples);
    c.framesWaiting = std::max(c.framesWaiting, ++e.framesWaiting);
    if (!e.isWanted) continue;
    if (e.moves() || e.mapIsStale) c.work += e.moves() ? moved : stale;
    ++c.vpls;
  }
  pairUp(groups);
  return groups;
}

// Pairs paths that disappear with new paths of the same light, so that the light does not become
// darker in between.
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

int LiveLights::refresh(ManyLightsKernels& kernels, const RefreshBudget& budget,
                        const RefreshWork& moved, const RefreshWork& stale) {
  refresh(budget, moved, stale);
  needMaps(std::vector<uint8_t>(static_cast<size_t>(slots_), 1));
  return updateMaps(kernels, {});
}

int LiveLights::refresh(const RefreshBudget& budget, const RefreshWork& moved,
                        const RefreshWork& stale) {
  tableIsCurrent_ = false;
  chooseFollowers(budget, moved);
  const std::vector<Group> groups = pendingGroups(moved, stale);
  std::vector<RefreshCandidate> candidates;
  for (const Group& group : groups) candidates.push_back(group.candidate);
  int refreshed = 0;
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
      if (e.wanted.id.bounce > 0) setShown(e.wanted.id.path(), true);
      if (!e.moves() && !e.mapIsStale) {
        takeBrightness(e);
        continue;
      }
      e.current = e.wanted.vpl;
      e.current.slot = e.slot;
      e.isLive = true;
      e.mapIsStale = e.hasMap = e.isMisplaced = false;
      e.staleShare = 0.0f;
      ++refreshed;
    }
  }
  std::erase_if(entries_, [](const Entry& e) { return !e.isWanted && !e.isLive; });
  hideMisplaced();
  return refreshed;
}

const LightSampleTable& LiveLights::table() const {
  if (tableIsCurrent_) return table_;
  table_.samples.clear();
  table_.samples.reserve(entries_.size());
  for (const Entry& e : entries_) {
    LightSample& sample = table_.samples.emplace_back();
    static_cast<SceneVpl&>(sample) = e.wanted;
    sample.isLive = e.isLive && !e.isHidden;
    if (sample.isLive) sample.vpl = e.current;
    sample.vpl.slot = e.slot;
    sample.isUpToDate = !e.moves() && !e.mapIsStale;
    sample.framesWaiting = e.framesWaiting;
  }
  sumShown();
  applyGains();
  setMapColumns();
  tableIsCurrent_ = true;
  return table_;
}

// What updateMaps() changes.
void LiveLights::setMapColumns() const {
  table_.hasMap.assign(static_cast<size_t>(slots_), 0);
  for (size_t i = 0; i < entries_.size(); ++i) {
    const Entry& e = entries_[i];
    table_.samples[i].isStale = e.isPending();
    if (e.hasMap) table_.hasMap[static_cast<size_t>(e.slot)] = 1;
  }
}

void LiveLights::sumShown() const {
  struct Set {
    float share = 0.0f;
    float missing = 0.0f;  // brightness of samples that will still come
    bool lacks = false;    // some have no room
  };
  std::map<VplId, Set> sets;
  for (const Entry& e : entries_) {
    const VplId& id = e.wanted.id;
    Set& set = sets[id.set()];
    // The old version of a path counts as its new version.
    if (isShown(e) ||
        (!e.isLive && id.bounce > 0 && pathIsShown_[indexOfShown(id.path())].isShown)) {
      set.share += e.share;
    } else if (e.wanted.isSample) {
      set.missing += e.share;
      set.lacks = set.lacks || e.hasNoRoom;
    }
  }
  table_.summed.assign(static_cast<size_t>(slots_), {});
  for (const Entry& e : entries_) {
    if (!isShown(e)) continue;
    shared::Vpl& vpl = table_.summed[static_cast<size_t>(e.slot)] = e.current;
    const Set& set = sets[e.wanted.id.set()];
    if ((set.missing <= kSmallShare && !set.lacks) || !(set.share > 0.0f)) continue;
    vpl.intensity /= set.share;
  }
}

void LiveLights::applyGains() const {
  table_.reference.assign(static_cast<size_t>(slots_), vec3(0.0f));
  for (LightSample& sample : table_.samples) {
    const vec3 gain = gainOf(gains_, sample.id);
    sample.vpl.intensity *= gain;
    const auto slot = static_cast<size_t>(sample.vpl.slot);
    table_.reference[slot] = table_.summed[slot].intensity;
    table_.summed[slot].intensity *= gain;
  }
}

int LiveLights::pending() const {
  return static_cast<int>(std::count_if(entries_.begin(), entries_.end(),
                                        [](const Entry& e) { return e.isPending(); }));
}

int LiveLights::live() const {
  int count = 0;
  const SceneVpl* last = nullptr;
  for (const Entry& e : entries_) {
    if (!isShown(e)) continue;
    count += last == nullptr || !isSameSun(*last, e.wanted);
    last = &e.wanted;
  }
  return count;
}

int LiveLights::oldestFrames() const {
  int oldest = 0;
  for (const Entry& e : entries_) {
    if (e.isPending()) oldest = std::max(oldest, e.framesWaiting);
  }
  return oldest;
}

}  // namespace lamplighter
