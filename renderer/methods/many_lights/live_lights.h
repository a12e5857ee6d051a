// The VPLs that are shown, with their shadow maps, on their way to those that are wanted. The
// unit of update is one VPL. Which of them have maps is another matter: those that the view
// looks up, as far as memory goes (paper 1, 6.2).
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/methods/inspection.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

class LiveLights {
 public:
  // What is wanted from now on. At once: VPLs that are no longer wanted go, and those that only
  // changed in brightness take it on, for neither needs a map. Those that must move stay, old as
  // they are and as bright, until refresh() has their turn; so do those whose brightness is off by
  // less than a twentieth, as that of all is when one path more is walked. So a drag changes no
  // more than it refreshes.
  //
  // The bounced VPLs of a path (VplId::path) that meets something else now are replaced together,
  // in one frame, and so is one that is wanted no more together with one that was not before.
  // `paths`: all of them, those that left no VPL included; needed to tell these from paths that are
  // to come.
  void want(std::vector<SceneVpl> wanted, std::span<const VplId> paths = {});
  // Something that casts shadows moved: maps that it may show in are stale. `spared`, if any, says
  // of a VPL that its map does not change nevertheless. Returns how many were spared.
  int markStale(std::span<const MoverFinder::Mover> movers,
                const std::function<bool(const shared::Vpl&)>& spared = {});
  // The maps are lost: nothing is shown until it is refreshed.
  void loseMaps();

  // Takes the pending VPLs and paths of highest priority that the budget is enough for and moves
  // each to where it is wanted; its map is lost, if it has one, until updateMaps(). `moved`,
  // `stale`: the work for one that is at another place, and for one whose map alone is out of date.
  // Returns how many.
  int refresh(const RefreshBudget& budget, const RefreshWork& moved = {},
              const RefreshWork& stale = {});

  struct MapLimits {
    int held = std::numeric_limits<int>::max();      // maps at a time
    int rendered = std::numeric_limits<int>::max();  // in this call
  };
  // Gives maps to the VPLs in the slots that are marked, spread over all of them where they do not
  // all fit or there are many at once, and takes maps from
  // others where there would be too many: from those that were not marked for longest. Returns how
  // many were rendered.
  int updateMaps(Backend& backend, const std::vector<uint8_t>& marked, const MapLimits& limits);
  // Once nothing is pending: renders the maps of at most `most` of those VPLs that are marked as
  // fine ones, the brightest first. Whoever is refreshed has a coarse one again. Returns how many
  // were rendered.
  int sharpenMaps(Backend& backend, const std::vector<uint8_t>& marked, int most);
  // How many it would render if it might render all.
  int coarse(const std::vector<uint8_t>& marked) const;
  // Whether what has no map is not to be shown at all (naive).
  void showOnlyMapped(bool onlyMapped);

  // Both, with a map for each VPL.
  int refresh(Backend& backend, const RefreshBudget& budget, const RefreshWork& moved = {},
              const RefreshWork& stale = {});

  // By slot, whether there is a map of the light as it is shown.
  std::vector<uint8_t> hasMap() const;
  int mapsHeld() const { return static_cast<int>(std::count(holds_.begin(), holds_.end(), 1)); }
  // Marked, but more than may be held.
  int withoutMap() const;

  // All of them, in the order of the wanted ones.
  std::vector<InspectedLight> inspect() const;

  // Whether the light in each slot is shown as it is wanted, with its map.
  std::vector<bool> upToDate() const;
  // By slot, whether the light in it has bounced so often or more.
  std::vector<bool> haveBounced(int times) const;

  // What to sum, in the order of the wanted ones, so that the sum does not depend on history. While
  // more than a twentieth of a set is missing those that are there carry the flux of all, so that
  // brightness neither jumps nor piles up when a light comes or the number of samples changes.
  std::vector<shared::Vpl> shown() const;

  int pending() const;
  int live() const;  // samples that are shown: a sun is one
  int oldestFrames() const;
  bool changed() const { return changed_; }  // since the last shown() that was cleared
  void clearChanged() { changed_ = false; }
  // Shadow maps to reserve. When this number changes the maps count as lost.
  int slots() const { return slots_; }

 private:
  struct Entry {
    SceneVpl wanted;
    float share = 1.0f;  // of its set's brightness, in [0, 1]
    int slot = -1;
    bool isWanted = true;     // else it is shown until its path's turn
    bool isLive = false;      // current is shown
    bool mapIsStale = false;  // its map shows what has moved
    bool isOff = false;       // its brightness is not quite what is wanted, its map is right
    float staleShare = 0.0f;  // of its map, that is out of date
    bool hasMap = false;      // of what is current
    bool isFine = false;      // the map, if there is one
    bool lacksMap = false;    // it is to get one
    bool hasNoRoom = false;   // it is marked, and others have all the room
    int framesWaiting = 0;
    shared::Vpl current{};
    bool moves() const;  // it is not where it is wanted
    bool mustRefresh() const { return moves() || mapIsStale || isOff; }
    bool isPending() const { return mustRefresh() || lacksMap; }
  };
  // What is refreshed together: a VPL, or those of a path that changes.
  struct Group {
    std::vector<size_t> entries;
    RefreshCandidate candidate{0.0f, 0, {}, 0};
  };
  std::vector<Group> pendingGroups(const RefreshWork& moved, const RefreshWork& stale);
  void pairUp(std::vector<Group>& groups) const;
  void keepReplaced(const std::map<VplId, size_t>& gone, std::vector<Entry>& next) const;
  void giveSlots();
  static void takeBrightness(Entry& entry);
  void fitSlots(size_t wanted);
  std::vector<uint32_t> spreadTurns() const;
  bool isCoarse(const Entry& e, const std::vector<uint8_t>& marked) const {
    return e.hasMap && !e.isFine && marked[static_cast<size_t>(e.slot)] != 0;
  }
  bool isShown(const Entry& e) const { return e.isLive && (e.hasMap || !onlyMapped_); }

  std::vector<Entry> entries_;         // in the order wanted, those that are not behind them
  std::map<VplId, bool> pathIsShown_;  // of all that bounce, whether as wanted or as it was
  int slots_ = 0;
  bool changed_ = true;
  bool onlyMapped_ = true;
  // By slot: the backend has a map, of whatever it is; when it was last marked.
  std::vector<uint8_t> holds_;
  std::vector<uint64_t> lastMarked_;
  uint64_t calls_ = 0;  // of updateMaps()
};

}  // namespace lamplighter
