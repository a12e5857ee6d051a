// For each patch and light sample whether anything can stand between (paper 1, 4.3.1 and 4.5.1):
// kept from edit to edit, and brought up to date where something changed. What a light leaves out
// (light_linking.h) is as if all of it were hidden from the light.
//
// Columns, one a light, are the unit of update: what moves is taken in at once, but a
// column that it may touch waits until it is refreshed, with its light's shadow map.
#pragma once

#include <limits>
#include <span>
#include <vector>

#include "renderer/visibility/light_clusters.h"
#include "renderer/visibility/movers/mover_path.h"
#include "renderer/visibility/object_identity.h"
#include "renderer/visibility/occlusion/occluders.h"
#include "renderer/visibility/occlusion/shadow_volume.h"

namespace lamplighter {

struct VisibilityCounts {
  size_t patches = 0;                      // nodes of all trees
  size_t divided = 0;                      // of them, those whose children are looked at apart
  size_t rows = 0;                         // of them, those that have entries of their own
  size_t none = 0, partial = 0, full = 0;  // entries of leaves, as they are
  size_t bytes = 0;
};

class VisibilityDatabase {
 public:
  // Takes in what changed in the scene: moved, added, removed, hidden and rescaled objects, and
  // materials. Rows of objects that are new or moved are partial in columns that wait.
  void setScene(const RenderScene& scene, const RenderSceneChanges& changes);

  // Entries take no more than this: patches are not divided so far down that they could. The roots
  // have theirs in any case, see leastBytes(). Holds from the next setLights() on; SIZE_MAX: no
  // limit.
  void limitMemory(size_t bytes) { mostBytes_ = bytes; }
  // What those of the roots take for so many lights.
  size_t leastBytes(size_t slots) const { return rowBytes(slots) * patchesAtLevels()[0]; }

  // The light samples by slot; a normal of zero: none is there. Those that differ from what was
  // there get new columns.
  void setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot);

  // Brings these columns up to date with all that moved. Of other objects only those entries are
  // looked at whose pyramid a mover met before or meets now: where it meets neither, it was no
  // blocker and is none. They are tested against the movers alone when the same ones moved before.
  void refresh(const RenderScene& scene, std::span<const int> slots);
  void refreshAll(const RenderScene& scene);
  bool isWaiting(int slot) const { return !waiting_[static_cast<size_t>(slot)].empty(); }

  // Whether everything that moved in the last setScene() was and is hidden from the light by one
  // polygon, so that its shadow map does not change.
  bool moversAreHidden(const shared::Vpl& vpl) const;
  // Whether one polygon hides all of a patch from the eye, a light at its place that looks on.
  bool isHiddenFromEye(const RenderScene& scene, const shared::Vpl& eye, uint32_t object,
                       int patch) const;
  size_t moversFound() const { return moves_.size(); }  // in the last setScene()

  const ObjectPatches& patches(uint32_t object) const { return patches_[object]; }
  size_t objects() const { return patches_.size(); }
  size_t slots() const { return lights_.size(); }
  Occlusion state(uint32_t object, int patch, int slot) const {
    return static_cast<Occlusion>(row(object, patch)[static_cast<size_t>(slot)]);
  }
  // All slots of a patch.
  std::span<const uint8_t> row(uint32_t object, int patch) const {
    const int whole = wholeOf(object, patch);
    return {rows_[object][static_cast<size_t>(whole)].states.data(), lights_.size()};
  }
  // The patch, or the one above it that is looked at as a whole.
  int wholeOf(uint32_t object, int patch) const {
    const std::vector<Patch>& patches = patches_[object].patches;
    int whole = patch, parent = patches[static_cast<size_t>(patch)].parent;
    for (; parent != kNone && !isDivided(object, parent);
         parent = patches[static_cast<size_t>(whole)].parent)
      whole = parent;
    return whole;
  }
  // Whether the children of a patch are looked at apart: enough lights are partial on it, and
  // memory goes so far. Where not they are as it is. None is below one that is not.
  bool isDivided(uint32_t object, int patch) const {
    return divided_[object][static_cast<size_t>(patch)] != 0;
  }

  // For each object its index before the last setScene(); kNone: its patches are new.
  const std::vector<int>& cameFrom() const { return cameFrom_; }
  // Whether an entry of the patch changed since clearChanged().
  bool rowChanged(uint32_t object, int patch) const {
    return changed_[object][static_cast<size_t>(wholeOf(object, patch))] != 0;
  }
  void clearChanged();

  // Whether several lights are looked at together, which changes nothing but the time.
  void useClusters(bool use) { useClusters_ = use; }

  // Pyramids against the scene, since the database was made.
  uint64_t tests() const { return tests_; }
  // For a light that moved, by the last ones that did.
  uint64_t testsPerColumn() const { return testsPerColumn_; }
  VisibilityCounts counts() const;  // goes through all entries
  size_t bytes() const;             // of the entries

 private:
  // An object that a column does not know the place of yet.
  struct Waiting {
    int object;              // kNone: it is gone
    Caster before;           // where the column has it; empty: nowhere
    bool couldHide = false;  // a whole patch, there
  };
  struct Move {
    Bounds before, after;
  };
  struct Column;  // a light, and what of the scene it has to take in
  struct SimpleColumns;
  enum class Work : uint8_t;
  struct Task;   // one light at one patch
  class Update;  // brings columns up to date (visibility_update.h)
  static constexpr uint8_t kUnknown = 255, kNoneAndMet = 3;
  static constexpr size_t kSlotsAStep = 64;  // by which rows grow
  static constexpr size_t kAllLevels = std::numeric_limits<size_t>::max();
  // What is known of a patch that is looked at: a root, or a part of one that is divided. By slot,
  // stride_ of them. Most patches are neither, which keeps large levels small.
  struct Row {
    std::vector<uint8_t> states;  // Occlusion; empty: it is as the patch above it
    // By all objects but those that moved last, from kNoneAndMet on none and where those were met
    // (MoverShadows::Hint); kUnknown: not asked yet; empty: none was, or
    // nothing moved, or there is no room. While the same ones move on, as in a drag, nothing else
    // is tested again (table 4-1).
    std::vector<uint8_t> withoutMovers;
    // Until when what the movers of now make of an entry that is none without them is sure to stay;
    // empty: not known, or there is no room.
    std::vector<MoverPath::Mark> standsTill;
  };
  using Flags = std::vector<std::vector<uint8_t>>;  // by object and patch

  void matchObjects(const RenderScene& scene, std::vector<Move>& moves);
  void takeMoved(const RenderScene& scene, const RenderSceneChanges& changes,
                 std::vector<Move>& moves);
  void setMovers(std::span<const uint32_t> objects);
  void placeObject(const RenderScene& scene, uint32_t object);
  void addWaiting(int object, const Caster& before, bool couldHide);
  void forgetOthers();
  void lowerMarks(MoverPath::Mark by);
  void growTree();
  // mayDivide: patches may be divided otherwise than they are, though nothing changed on them:
  // others are gone, or there is more memory or less.
  void computeNew(const RenderScene& scene, std::span<const int> slots, bool mayDivide);
  void computeWaiting(const RenderScene& scene, std::span<const int> slots);
  Column takeWaiting(int slot);
  int mostPartial() const;
  void resize(size_t slots);
  std::vector<size_t> patchesAtLevels() const;  // one at least
  static size_t rowBytes(size_t slots) {
    return (slots + kSlotsAStep - 1) / kSlotsAStep * kSlotsAStep;
  }
  bool takeMemoryLimit(size_t stride);
  void forgetBelow();

  // By object.
  std::vector<MeshTopology> topologies_;
  std::vector<ObjectIdentity> identities_;
  std::vector<ObjectPatches> patches_;
  std::vector<int> cameFrom_;
  std::vector<std::vector<Row>> rows_;  // and patch
  Flags divided_, changed_;
  std::vector<uint32_t> movers_;  // that moved last
  MoverPath path_;                // of these
  std::vector<Move> moves_;       // of the last setScene()

  Occluders occluders_;
  BoundsTree tree_;                            // over objects' patches
  std::vector<shared::Vpl> lights_;            // by slot
  std::vector<uint8_t> isLive_;                // by slot
  LightClusters clusters_;                     // of all lights
  std::vector<std::vector<Waiting>> waiting_;  // by slot
  // By slot: some of the waiting column was computed where the movers are now.
  std::vector<uint8_t> knowsNow_;
  bool useClusters_ = true;
  int most_ = -1;  // that a patch that is not divided may have
  size_t mostBytes_ = std::numeric_limits<size_t>::max();
  size_t levels_ = kAllLevels;  // that may have entries of their own; the roots are the first
  bool keepsOthers_ = true;     // there is room for Row::withoutMovers
  bool keepsMarks_ = true;      // and for Row::standsTill
  bool limitChanged_ = false;
  size_t stride_ = 0;  // of rows, in slots
  uint64_t tests_ = 0, testsPerColumn_ = 0;
};

}  // namespace lamplighter
