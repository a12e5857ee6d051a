// The visibility database: for each patch and VPL, whether anything can block the light (paper 1,
// 4.3.1 and 4.5.1). It is kept between edits and updated where something changed. For an object
// that a light excludes (light_linking.h) the entries are `full`, as if the light were hidden.
//
// The unit of update is a column (all entries of one light). The database registers movements at
// once, but a column that may be affected waits until it is refreshed together with the shadow map
// of its light.
//
// Only requested patches have entries. For the others every light is partial: their pixels read
// shadow maps, so the picture is the same.
#pragma once

#include <filesystem>
#include <limits>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "renderer/patches/mesh_topologies.h"
#include "renderer/visibility/light_clusters.h"
#include "renderer/visibility/movers/mover_path.h"
#include "renderer/visibility/object_identity.h"
#include "renderer/visibility/occlusion/occluders.h"
#include "renderer/visibility/occlusion/shadow_volume.h"
#include "renderer/visibility/patch_demand.h"

namespace lamplighter {

struct VisibilityCounts {
  size_t patches = 0;                      // nodes of all trees
  size_t divided = 0;                      // patches whose children have entries of their own
  size_t rows = 0;                         // patches that have entries of their own
  size_t none = 0, partial = 0, full = 0;  // entries of leaves, in their stored state
  size_t bytes = 0;
};

class VisibilityDatabase {
 public:
  // cacheFolder: where topologies are kept between runs (MeshTopologies).
  explicit VisibilityDatabase(std::filesystem::path cacheFolder = {})
      : meshes_(std::move(cacheFolder)) {}

  // Registers changes of the scene: moved, added, removed, hidden and rescaled objects, and
  // materials. Entries of new or moved objects are partial in columns that wait.
  void setScene(const RenderScene& scene, const RenderSceneChanges& changes);

  // Sets which patches have entries; initially all. Entries that are no longer requested are
  // discarded at once, new ones are computed by answer(). Call it after each setScene().
  void ask(const PatchDemand& demand);
  // Computes missing entries of requested patches, the largest patches first, until `mostTests`
  // pyramids have been tested. Call it after setLights().
  void answer(const RenderScene& scene, uint64_t mostTests);
  // By patch of an object: for roots with entries, the levels of their trees that may have some, as
  // in PatchDemand; 0: no entries, or no root.
  std::span<const uint8_t> levels(uint32_t object) const { return given_[object]; }
  size_t unanswered() const { return unanswered_; }  // number of roots that answer() left
  bool asksForAll() const { return demand_.isForAll; }

  // Limits the memory of the entries: patches are divided only as far as the limit allows. The
  // roots always have entries, see leastBytes(). Takes effect with the next setLights(); SIZE_MAX:
  // no limit.
  void limitMemory(size_t bytes) { mostBytes_ = bytes; }
  // Memory of the entries of the roots for this number of lights.
  size_t leastBytes(size_t slots) const { return rowBytes(slots) * patchesAtLevels()[0]; }
  // Memory of the entries of one patch for this number of lights.
  static size_t rowBytes(size_t slots) {
    return (slots + kSlotsAStep - 1) / kSlotsAStep * kSlotsAStep;
  }

  // Sets the VPLs by slot; a normal of zero means an empty slot. A VPL that differs from the
  // previous one in its slot gets a new column.
  void setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot);

  // Updates these columns for everything that moved. For objects that did not move, only those
  // entries are tested whose pyramid a mover intersected before or intersects now; otherwise the
  // mover blocked nothing and blocks nothing. If the same objects moved before, only the movers are
  // tested.
  void refresh(const RenderScene& scene, std::span<const int> slots);
  void refreshAll(const RenderScene& scene);
  bool isWaiting(int slot) const { return !waiting_[static_cast<size_t>(slot)].empty(); }

  // Whether each object that moved in the last setScene() was and is hidden from the light by one
  // polygon, so that the light's shadow map does not change.
  bool moversAreHidden(const shared::Vpl& vpl) const;
  // Whether one polygon hides the whole patch from the eye. `eye`: a VPL at the eye that faces the
  // view direction.
  bool isHiddenFromEye(const RenderScene& scene, const shared::Vpl& eye, uint32_t object,
                       int patch) const;
  size_t moversFound() const { return moves_.size(); }  // in the last setScene()

  const ObjectPatches& patches(uint32_t object) const { return patches_[object]; }
  std::span<const ObjectPatches> patches() const { return patches_; }
  size_t objects() const { return patches_.size(); }
  size_t slots() const { return lights_.size(); }
  Occlusion state(uint32_t object, int patch, int slot) const {
    return static_cast<Occlusion>(row(object, patch)[static_cast<size_t>(slot)]);
  }
  // The entries of a patch, by slot.
  std::span<const uint8_t> row(uint32_t object, int patch) const {
    const Row& row = rows_[object][static_cast<size_t>(wholeOf(object, patch))];
    return {(row.states.empty() ? withoutEntries(object) : row.states).data(), lights_.size()};
  }
  // The patch itself, or its nearest ancestor that has entries of its own.
  int wholeOf(uint32_t object, int patch) const {
    const std::vector<Patch>& patches = patches_[object].patches;
    int whole = patch, parent = patches[static_cast<size_t>(patch)].parent;
    for (; parent != kNone && !isDivided(object, parent);
         parent = patches[static_cast<size_t>(whole)].parent)
      whole = parent;
    return whole;
  }
  // Whether the children of a patch have entries of their own: enough lights are partial on the
  // patch, and the memory limit allows it. Otherwise the children share its entries. No patch below
  // an undivided one is divided.
  bool isDivided(uint32_t object, int patch) const {
    return divided_[object][static_cast<size_t>(patch)] != 0;
  }

  // By object: its index before the last setScene(); kNone: its patches are new.
  const std::vector<int>& cameFrom() const { return cameFrom_; }
  // Whether an entry of the patch changed since clearChanged().
  bool rowChanged(uint32_t object, int patch) const {
    return changed_[object][static_cast<size_t>(wholeOf(object, patch))] != 0;
  }
  void clearChanged();

  // Whether several lights are tested together. This changes only the time, not the result.
  void useClusters(bool use) { useClusters_ = use; }

  // Number of pyramids tested against the scene since construction.
  uint64_t tests() const { return tests_; }
  // Tests for one moved light, from the last lights that moved.
  uint64_t testsPerColumn() const { return testsPerColumn_; }
  VisibilityCounts counts() const;  // iterates over all entries
  size_t bytes() const;             // memory of the entries

 private:
  // An object whose new position a column has not processed yet.
  struct Waiting {
    int object;              // kNone: the object was removed
    Caster before;           // the position that the column has processed; empty: none
    bool couldHide = false;  // whether it could hide a whole patch at that position
  };
  struct Move {
    Bounds before, after;
  };
  struct Column;  // a light, and the changes of the scene that it must process
  struct SimpleColumns;
  enum class Work : uint8_t;
  struct Task;   // one light at one patch
  class Update;  // updates columns (visibility_update.h)
  static constexpr uint8_t kUnknown = 255, kNoneAndMet = 3;
  static constexpr size_t kSlotsAStep = 64;  // increment by which rows grow
  static constexpr size_t kAllLevels = std::numeric_limits<size_t>::max();
  // Entries of a root, or of a part of a divided patch; by slot, stride_ of each. Most patches are
  // neither, so that large levels need little memory.
  struct Row {
    std::vector<uint8_t> states;  // Occlusion; empty: the patch shares the entries of its parent
    // The entries without the objects that moved last; values of at least kNoneAndMet mean none,
    // plus where the movers were hit (MoverShadows::Hint); kUnknown: not tested yet. Empty: nothing
    // was tested, nothing moved, or the memory limit does not allow it. While the same objects keep
    // moving, as in a drag, only they are tested again (table 4-1).
    std::vector<uint8_t> withoutMovers;
    // For entries that are none without the movers: the mark up to which the result with the movers
    // is certain to stay valid. Empty: unknown, or the memory limit does not allow it.
    std::vector<MoverPath::Mark> standsTill;
  };
  using Flags = std::vector<std::vector<uint8_t>>;  // by object and patch

  // The entries of patches that have none: partial, or full for lights that leave the object out.
  const std::vector<uint8_t>& withoutEntries(uint32_t object) const {
    const auto found = leftOutEntries_.find(leftOutBy_[object]);
    return found == leftOutEntries_.end() ? partialEntries_ : found->second;
  }
  void fillWithoutEntries(const RenderScene& scene);
  void giveRow(uint32_t object, int root);
  void dropRoot(uint32_t object, int root);
  // Levels of a root's tree that may have entries: requested, and current.
  uint8_t levelsAsked(uint32_t object, int root) const {
    return demand_.isForAll ? PatchDemand::kAllLevels
                            : demand_.levels[object][static_cast<size_t>(root)];
  }
  uint8_t levelsGiven(uint32_t object, int root) const {
    return given_[object][static_cast<size_t>(root)];
  }
  void matchObjects(const RenderScene& scene, std::vector<Move>& moves);
  void grow(size_t objects);
  void takeMoved(const RenderScene& scene, const RenderSceneChanges& changes,
                 std::vector<Move>& moves);
  void setMovers(std::span<const uint32_t> objects);
  void findTopologies(const RenderScene& scene, std::span<const uint32_t> objects, bool areMoving);
  void placeObject(const RenderScene& scene, uint32_t object);
  void addWaiting(int object, const Caster& before, bool couldHide);
  void forgetOthers();
  void lowerMarks(MoverPath::Mark by);
  void growTree();
  // mayDivide: the division of unchanged patches may change too, because other patches were removed
  // or the memory limit changed.
  void computeNew(const RenderScene& scene, std::span<const int> slots, bool mayDivide);
  void computeWaiting(const RenderScene& scene, std::span<const int> slots);
  Column takeWaiting(int slot);
  int mostPartial() const;
  void resize(size_t slots);
  std::vector<size_t> patchesAtLevels() const;  // has at least one element
  bool takeMemoryLimit(size_t stride);
  void forgetBelow();

  MeshTopologies meshes_;
  // By object.
  std::vector<std::shared_ptr<const MeshTopology>> topologies_;
  std::vector<ObjectIdentity> identities_;
  std::vector<ObjectPatches> patches_;
  std::vector<int> cameFrom_;
  std::vector<std::vector<Row>> rows_;  // by object and patch
  Flags divided_, changed_;
  // By object and patch: for roots with entries, the levels of their trees that may have some.
  Flags given_;
  PatchDemand demand_;
  std::vector<size_t> askedAtLevels_{0};  // by tree level: the most patches that demand_ asks for
  bool wasAsked_ = false;                 // ask() was called
  size_t unanswered_ = 0;
  // Entries of patches without entries of their own, by LightLinks bits of the object.
  std::vector<uint8_t> partialEntries_;
  std::map<uint32_t, std::vector<uint8_t>> leftOutEntries_;
  std::vector<uint32_t> leftOutBy_;  // by object
  std::vector<uint32_t> movers_;     // objects that moved last
  MoverPath path_;                   // path of the movers
  std::vector<Move> moves_;          // in the last setScene()

  Occluders occluders_;
  BoundsTree tree_;                            // over the bounds of the objects' patches
  std::vector<shared::Vpl> lights_;            // by slot
  std::vector<uint8_t> isLive_;                // by slot
  LightClusters clusters_;                     // of all lights
  std::vector<std::vector<Waiting>> waiting_;  // by slot
  // By slot: part of the waiting column was computed with the present positions of the movers.
  std::vector<uint8_t> knowsNow_;
  bool useClusters_ = true;
  // Largest number of partial lights on a patch that is not divided. Without lights none is.
  int most_ = std::numeric_limits<int>::max();
  size_t mostBytes_ = std::numeric_limits<size_t>::max();
  size_t levels_ = kAllLevels;  // number of tree levels that may have entries of their own; the
                                // first are the roots
  bool keepsOthers_ = true;     // memory allows Row::withoutMovers
  bool keepsMarks_ = true;      // memory allows Row::standsTill
  bool limitChanged_ = false;
  size_t stride_ = 0;  // entries per row, in slots
  uint64_t tests_ = 0, testsPerColumn_ = 0;
};

}  // namespace lamplighter
