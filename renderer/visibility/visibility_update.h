// How columns of the visibility database are brought up to date; its own files only include this.
#pragma once

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// What is to be done for a light at a patch.
enum class VisibilityDatabase::Work : uint8_t {
  inherit,  // it is as it is at the parent
  check,    // it is as it was, but for what moved
  anew
};

struct VisibilityDatabase::Column {
  int slot = 0;
  bool moversAreAll = true;      // what it waits for are the movers of now, and no more
  bool moversHidNothing = true;  // nor could what it waits for hide a patch alone
  // Of what it waits for, before and now; most wait for one thing.
  ShadowReach reach;
  std::vector<ShadowReach> more;
  std::vector<int> objects;  // that it waits for: all their entries
  bool mayFallOn(const vec3& centre, float radius) const {
    return reach.mayFallOn(centre, radius) ||
           std::any_of(more.begin(), more.end(),
                       [&](const ShadowReach& r) { return r.mayFallOn(centre, radius); });
  }
};

struct VisibilityDatabase::Task {
  const Column* column = nullptr;  // null: that of a light of which nothing moved
  int slot = 0;
  Work work = Work::anew;
  bool isNew = false;
  bool isOfMover = false;  // the column waits for the object
  // The entry before was not found by its own pyramid, which is not quite in that of the parent.
  bool parentWasNone = false;
  bool isSieved = false;                 // nothing that moved can be between: it stays
  Occlusion was = Occlusion::partial;    // the entry before
  Occlusion state = Occlusion::partial;  // inherit: the parent's; afterwards the entry
  Blocker met, metMover;                 // at the parent, then here
};

// Goes patch by patch from the roots, at each for all lights at once, so that it is known there
// whether the patch is divided before its children are looked at.
class VisibilityDatabase::Update {
 public:
  // allMayDivide: patches may be divided otherwise than they are though nothing changed on them.
  // `order`: all slots.
  Update(VisibilityDatabase& database, const RenderScene& scene, bool allMayDivide,
         std::span<const int> order, std::atomic<uint64_t>& tests)
      : db_(database), scene_(scene), allMayDivide_(allMayDivide), order_(order), tests_(tests) {
    for (const uint32_t mover : database.movers_)
      moversMayHide_ = moversMayHide_ || database.occluders_.mayHide(mover);
  }

  // The root and all below it; tasks in the order of slots.
  void run(uint32_t object, int root, std::span<const Task> tasks) {
    tasks_.assign(tasks.begin(), tasks.end());
    visit(object, root, 0, 0);
  }

 private:
  void visit(uint32_t object, int patch, size_t level, size_t first);
  void beginParts(uint32_t object, int patch, std::span<const Task> tasks, bool changedBefore);
  void forgetParts(uint32_t object, int patch);
  bool compute(uint32_t object, int patch, std::span<Task> tasks) const;
  // What may stand between the lights of a cluster and a patch, looked for when first wanted.
  struct Shaft {
    int cluster = -1;
    size_t first = 0, last = 0;  // of its tasks
    LightShaft shaft{{}, PatchRegion(Bounds())};
    Occluders::Candidates candidates;
  };
  // A task among others at the same patch.
  struct Place {
    std::span<const Task> tasks;
    size_t index;
    Shaft& shaft;
  };
  const Occluders::Candidates* candidatesOf(const Place& place, const PatchRegion& region) const;
  Occlusion check(const Patch& patch, const PatchRegion& region, const Task& task,
                  const Place& place, bool& isSieved, uint8_t& others, Blocker& met,
                  Blocker& metMover, uint64_t& tests) const;
  // Whether no mover makes a difference where this is the state by all others.
  bool isDecided(uint8_t others) const {
    return others == static_cast<uint8_t>(Occlusion::full) ||
           (others == static_cast<uint8_t>(Occlusion::partial) && !moversMayHide_);
  }
  void passDown(uint32_t object, int patch, int child, bool wasDivided, size_t first, size_t last);

  VisibilityDatabase& db_;
  const RenderScene& scene_;
  const bool allMayDivide_;
  const std::span<const int> order_;
  bool moversMayHide_ = false;
  std::atomic<uint64_t>& tests_;
  std::vector<Task> tasks_;  // those of the patch that is visited are the last
};

}  // namespace lamplighter
