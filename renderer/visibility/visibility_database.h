// For each patch and light sample whether anything can stand between (paper 1, 4.3.1 and 4.5.1):
// kept from edit to edit, and brought up to date where something changed.
#pragma once

#include <span>
#include <vector>

#include "renderer/visibility/occluders.h"

namespace lamplighter {

struct VisibilityCounts {
  size_t patches = 0;                      // nodes of all trees
  size_t none = 0, partial = 0, full = 0;  // entries of leaves, as they are
  size_t bytes = 0;
};

class VisibilityDatabase {
 public:
  // Takes in what changed in the scene. Rows of moved objects are new; of the others only those
  // entries are looked at again whose pyramid the object met before or meets now: where it meets
  // neither, it was no blocker and is none. They are tested against the moved objects alone when
  // the same ones moved before.
  void setScene(const RenderScene& scene, const RenderSceneChanges& changes);

  // The light samples by slot; a normal of zero: none is there. Those that differ from what was
  // there get new columns.
  void setLights(const RenderScene& scene, std::span<const shared::Vpl> bySlot);

  const ObjectPatches& patches(uint32_t object) const { return patches_[object]; }
  size_t objects() const { return patches_.size(); }
  Occlusion state(uint32_t object, int patch, int slot) const {
    return static_cast<Occlusion>(
        rows_[object][static_cast<size_t>(patch) * stride_ + static_cast<size_t>(slot)]);
  }
  // All slots of a patch.
  std::span<const uint8_t> row(uint32_t object, int patch) const {
    return {&rows_[object][static_cast<size_t>(patch) * stride_], lights_.size()};
  }
  size_t slots() const { return lights_.size(); }
  // Whether an entry of the patch changed since clearChanged().
  bool rowChanged(uint32_t object, int patch) const {
    return changed_[object][static_cast<size_t>(patch)] != 0;
  }
  void clearChanged();
  // Pyramids against the scene, since the database was made.
  uint64_t tests() const { return tests_; }
  VisibilityCounts counts() const;  // goes through all entries

 private:
  struct Moved {
    Bounds before, after;
  };
  void compute(const RenderScene& scene, uint32_t object, int patch, int slot,
               std::span<const Moved> moved, uint64_t& tests);
  void forgetOthers();
  void set(uint32_t object, int patch, int slot, Occlusion state);
  void fill(uint32_t object, int patch, int slot, Occlusion state);
  void resize(size_t slots);
  void computeAll(const RenderScene& scene, std::span<const uint32_t> objects,
                  std::span<const int> slots, std::span<const Moved> moved);

  std::vector<ObjectPatches> patches_;
  Occluders occluders_;
  std::vector<shared::Vpl> lights_;         // by slot
  size_t stride_ = 0;                       // of rows, in slots
  std::vector<std::vector<uint8_t>> rows_;  // by object: patches × slots, Occlusion
  // The objects that moved last, and the state of each entry by all others (kUnknown: not asked
  // yet): while the same ones move on, as in a drag, nothing else is tested again (table 4-1).
  std::vector<uint32_t> movers_;
  std::vector<std::vector<uint8_t>> withoutMovers_;  // as rows_
  std::vector<std::vector<uint8_t>> changed_;        // by object and patch
  uint64_t tests_ = 0;
};

}  // namespace lamplighter
