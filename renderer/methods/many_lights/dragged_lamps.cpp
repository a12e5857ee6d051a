// Dragged lamps in LiveLights: a fixed part of their samples follows in each frame and carries all
// their light. With all samples in turn, the lamp would be at several places at once.
#include <algorithm>
#include <array>

#include "renderer/methods/many_lights/live_lights.h"

namespace lamplighter {
namespace {

// Possible parts of the samples that follow. The first points of a light's sequence are distributed
// as evenly as all of them.
constexpr std::array kShares{1.0f, 0.75f, 0.5f, 0.375f, 0.25f, 0.1875f, 0.125f, 0.09375f, 0.0625f};

// The part of a frame's refreshes that they may take; bounced light and other lights get the rest.
constexpr float kBudgetShare = 0.75f;

// A budget that varies between frames must not exchange the samples: their number grows only if the
// budget allows this many times as many.
constexpr float kGrowth = 2.0f;

// How many moved VPLs fit into that part of the budget.
float roomOf(const RefreshBudget& budget, const RefreshWork& moved) {
  auto room = static_cast<double>(std::max(budget.vpls, 0));
  const auto limit = [&](uint64_t most, uint64_t each) {
    if (most != kNoLimit && each > 0)
      room = std::min(room, static_cast<double>(most) / static_cast<double>(each));
  };
  limit(budget.work.shadowMaps, moved.shadowMaps);
  limit(budget.work.visibilityTests, moved.visibilityTests);
  limit(budget.work.lightMapTexels, moved.lightMapTexels);
  limit(budget.work.rays, moved.rays);
  return kBudgetShare * static_cast<float>(room);
}

// The largest part that fits, or that of the last frame if there is not much more room; 0: none.
float shareThatFits(float room, float samples, float last) {
  const auto* fits = std::ranges::find_if(kShares, [&](float s) { return s * samples <= room; });
  const float share = fits == kShares.end() ? 0.0f : *fits;
  const bool isLittleMore = last > 0.0f && share > last && share < 1.0f && share < kGrowth * last;
  return isLittleMore ? last : share;
}

}  // namespace

// Chooses which samples of the lamps that move now follow, and which wait until they rest.
void LiveLights::chooseFollowers(const RefreshBudget& budget, const RefreshWork& moved) {
  std::map<VplId, int> lamps;  // with their numbers of samples
  for (const Entry& e : entries_)
    if (e.movesNow) lamps.try_emplace(e.wanted.id.set());
  int all = 0;
  for (Entry& e : entries_) {
    e.follows = e.waitsForRest = false;
    const auto lamp = lamps.find(e.wanted.id.set());
    if (lamp == lamps.end() || !e.isWanted) continue;
    ++lamp->second;
    ++all;
  }
  const float room = roomOf(budget, moved);
  followShare_ = all == 0 ? 0.0f : shareThatFits(room, static_cast<float>(all), followShare_);
  if (followShare_ == 0.0f) return;
  for (auto& [lamp, count] : lamps)
    count = std::max(1, static_cast<int>(followShare_ * static_cast<float>(count)));
  // The samples of a lamp are in the order of its sequence.
  for (Entry& e : entries_) {
    const auto lamp = lamps.find(e.wanted.id.set());
    if (lamp == lamps.end() || !e.isWanted) continue;
    e.follows = lamp->second-- > 0;
    e.waitsForRest = !e.follows && e.movesNow;
    // It is not visible, so its waiting time restarts when the drag ends.
    if (e.waitsForRest) e.framesWaiting = 0;
  }
}

// If all samples that follow are in place, the others are hidden until they are refreshed.
void LiveLights::hideMisplaced() {
  struct Lamp {
    bool hasPlaced = false, lacks = false;  // lacks: some that follow are not in place
  };
  std::map<VplId, Lamp> lamps;
  for (Entry& e : entries_) {
    if (!e.moves()) e.isMisplaced = false;  // its lamp is back
    if (e.isMisplaced) lamps.try_emplace(e.wanted.id.set());
  }
  for (const Entry& e : entries_) {
    const auto lamp = lamps.find(e.wanted.id.set());
    if (lamp == lamps.end()) continue;
    lamp->second.hasPlaced = lamp->second.hasPlaced || (e.isLive && !e.isMisplaced);
    lamp->second.lacks = lamp->second.lacks || (e.follows && e.isMisplaced);
  }
  for (Entry& e : entries_) {
    const auto lamp = lamps.find(e.wanted.id.set());
    const bool hides = e.isMisplaced && (e.isHidden || e.waitsForRest) && lamp->second.hasPlaced &&
                       !lamp->second.lacks;
    changed_ = changed_ || hides != e.isHidden;
    e.isHidden = hides;
    e.movesNow = false;
  }
}

}  // namespace lamplighter
