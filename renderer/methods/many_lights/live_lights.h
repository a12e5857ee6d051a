// The VPLs that are shown, with their shadow maps, as they are updated towards the wanted ones. The
// unit of update is one VPL. While a lamp is dragged, only samples that follow it are shown, as
// soon as there are enough of them, and carry its flux: a picture with fewer samples is better than
// one with the lamp at several places. Shadow maps are managed separately: the VPLs whose maps the
// view reads have one, as far as memory allows (paper 1, 6.2).
#pragma once

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <span>
#include <vector>

#include "renderer/backends/many_lights_kernels.h"
#include "renderer/sampling/light_gains.h"
#include "renderer/sampling/light_sample_table.h"
#include "renderer/shadow_maps/refresh_scheduler.h"

namespace lamplighter {

class LiveLights {
 public:
  // Sets the wanted VPLs. Two changes apply immediately, because they need no shadow map: VPLs that
  // are no longer wanted disappear, and VPLs that changed only in brightness take the new
  // brightness. VPLs that must move keep their old position and brightness until refresh() chooses
  // them. The same applies to VPLs whose brightness differs by less than a twentieth; this happens
  // to all VPLs when the number of paths grows by one. So a drag changes only what it refreshes.
  //
  // If a path (VplId::path) now hits something else, its indirect VPLs are replaced together, in
  // one frame. A VPL that is no longer wanted and its new replacement also change together.
  // `paths`: all paths, including those without a VPL; needed to distinguish them from paths that
  // are not traced yet.
  // The VPLs are at the reference brightness of their lights.
  void want(std::vector<SceneVpl> wanted, std::span<const VplId> paths = {});
  // Sets the brightness of all lights, which applies immediately.
  void setGains(LightGains gains);
  // Shadow casters moved: maps that may show them become stale, and the samples of those that are
  // lamps are misplaced until they are refreshed. `spared`, if given, tells that a VPL's map does
  // not change nevertheless. Returns the number of spared maps.
  int markStale(std::span<const MoverFinder::Mover> movers,
                const std::function<bool(const shared::Vpl&)>& spared = {});
  // All maps are lost: nothing is shown until it is refreshed.
  void loseMaps();

  // Moves the pending VPLs and paths with the highest priority to their wanted state, as far as the
  // budget allows. A moved VPL loses its map until updateMaps(). `moved`, `stale`: the work for a
  // VPL that moves, and for one with only a stale map. Returns the number of VPLs.
  int refresh(const RefreshBudget& budget, const RefreshWork& moved = {},
              const RefreshWork& stale = {});

  struct MapLimits {
    int held = std::numeric_limits<int>::max();      // maps in memory
    int rendered = std::numeric_limits<int>::max();  // in this call
  };
  // Sets the slots whose maps the view reads, until the next call.
  void needMaps(std::vector<uint8_t> bySlot) { table_.needsMap = std::move(bySlot); }
  // Renders the needed maps. If they do not all fit, or many are new, the maps are spread over all
  // VPLs that need one. If memory is short, maps are taken from the VPLs that have not needed
  // theirs for the longest time. Returns the number of rendered maps.
  int updateMaps(ManyLightsKernels& kernels, const MapLimits& limits);
  // When nothing is pending: renders fine maps for up to `most` VPLs that need one, brightest
  // first. A refreshed VPL gets a coarse map again. Returns the number of rendered maps.
  int sharpenMaps(ManyLightsKernels& kernels, int most);
  // The same for punctual hard-shadow lights only, whatever is pending: the borders of their
  // shadows show the texels of a coarse map. Those of a sun have small tiles. Counts as a change at
  // once.
  int sharpenHardLights(ManyLightsKernels& kernels, int most);
  // The number of fine maps that an unlimited call would render.
  int coarse() const;
  // Whether VPLs without a map are not shown at all (naive).
  void showOnlyMapped(bool onlyMapped);

  // refresh() and updateMaps(), with a map for each VPL.
  int refresh(ManyLightsKernels& kernels, const RefreshBudget& budget,
              const RefreshWork& moved = {}, const RefreshWork& stale = {});

  int mapsHeld() const { return static_cast<int>(std::count(holds_.begin(), holds_.end(), 1)); }
  // The number of needed maps that do not exist because of the memory limit.
  int withoutMap() const;

  // All VPLs. While more than a twentieth of a set is missing, the sum of the present VPLs carries
  // the flux of the whole set, so that the brightness neither jumps nor accumulates when a light is
  // added or the number of samples changes. Built once per frame, at the first call after
  // refresh(); updateMaps() then sets the data that depends on maps.
  const LightSampleTable& table() const;

  int pending() const;
  int missingSunTiles() const;  // number of tiles that are wanted, but not shown
  int live() const;             // number of samples shown; a sun counts as one
  int oldestFrames() const;
  // Since the last clearChanged(). Fine maps count once all are rendered, because a sum for each
  // few of them would take longer than the maps.
  bool changed() const { return changedBesideGains() || gainsChanged_; }
  bool changedBesideGains() const { return changed_ || (isSharper_ && coarse() == 0); }
  bool gainsChanged() const { return gainsChanged_; }
  void clearChanged() { changed_ = isSharper_ = gainsChanged_ = false; }
  // The number of shadow map slots to reserve. When it changes, all maps are lost.
  int slots() const { return slots_; }

 private:
  struct Entry {
    SceneVpl wanted;
    float share = 1.0f;  // of the brightness of its set, in [0, 1]
    int slot = -1;
    bool isWanted = true;       // else it is shown until its path is replaced
    bool isLive = false;        // `current` is shown
    bool mapIsStale = false;    // its map does not show a movement
    bool isOff = false;         // only its brightness differs slightly from the wanted one
    bool isMisplaced = false;   // its lamp has moved since it was refreshed
    bool movesNow = false;      // its lamp has moved since the last frame
    bool follows = false;       // it is refreshed in each frame of a drag of its lamp
    bool waitsForRest = false;  // it is not refreshed during the drag
    bool isHidden = false;      // live, but not shown: those that follow carry its flux
    float staleShare = 0.0f;    // share of its map that is out of date
    bool hasMap = false;        // of `current`
    bool isFine = false;        // the kind of its map
    bool lacksMap = false;      // it waits for a map
    bool hasNoRoom = false;     // it needs a map, but no memory is left
    int framesWaiting = 0;
    shared::Vpl current{};
    bool moves() const;  // it is not at its wanted position
    bool isOfLamp() const { return wanted.isSample && wanted.id.bounce == 0; }
    bool mustRefresh() const { return moves() || mapIsStale || isOff; }
    bool isPending() const { return mustRefresh() || lacksMap; }
  };
  // The unit of a refresh: one VPL, or the VPLs of a path that changes.
  struct Group {
    std::vector<size_t> entries;
    RefreshCandidate candidate{0.0f, 0, {}, 0};
  };
  std::vector<Group> pendingGroups(const RefreshWork& moved, const RefreshWork& stale);
  struct UnseenLamp {
    float brightness = 0.0f;
    int samples = 0;  // that have a priority so far
  };
  std::map<VplId, UnseenLamp> unseenLamps() const;
  void pairUp(std::vector<Group>& groups) const;
  void chooseFollowers(const RefreshBudget& budget, const RefreshWork& moved);
  void hideMisplaced();
  void keepReplaced(const std::map<VplId, size_t>& gone, std::vector<Entry>& next) const;
  // An indirect path, and whether its wanted or its old version is shown.
  struct ShownPath {
    VplId path;
    bool isShown = false;
  };
  void takeShown(std::vector<ShownPath> shown);
  size_t indexOfShown(const VplId& path) const;  // in pathIsShown_, or its size
  bool isKnown(const VplId& path) const { return indexOfShown(path) < pathIsShown_.size(); }
  void setShown(const VplId& path, bool isShown);
  void giveSlots();
  template <typename IsMeant>
  int sharpen(ManyLightsKernels& kernels, int most, const IsMeant& isMeant);
  void setMapColumns() const;
  void sumShown() const;
  void applyGains() const;
  static void takeBrightness(Entry& entry);
  void fitSlots(size_t wanted);
  std::vector<uint32_t> spreadTurns() const;
  bool needsMap(const Entry& e) const { return table_.needsMap[static_cast<size_t>(e.slot)] != 0; }
  bool isCoarse(const Entry& e) const { return e.hasMap && !e.isFine && needsMap(e); }
  bool isShown(const Entry& e) const {
    return e.isLive && !e.isHidden && (e.hasMap || !onlyMapped_);
  }

  LightGains gains_;
  float followShare_ = 0.0f;  // of the samples of dragged lamps
  // at the reference brightness of their lights
  std::vector<Entry> entries_;          // in the order of the wanted ones, then unwanted ones
  std::vector<ShownPath> pathIsShown_;  // of the wanted set, sorted
  int slots_ = 0;
  bool changed_ = true;
  bool isSharper_ = false;  // fine maps were rendered
  bool gainsChanged_ = false;
  bool onlyMapped_ = true;
  mutable LightSampleTable table_;  // its rows in the order of entries_
  mutable bool tableIsCurrent_ = false;
  // By slot: the kernels have a map in it (of any light); the call in which it was last needed.
  std::vector<uint8_t> holds_;
  std::vector<uint64_t> lastNeeded_;
  uint64_t calls_ = 0;  // number of updateMaps() calls
};

}  // namespace lamplighter
