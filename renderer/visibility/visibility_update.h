// Updates columns of the visibility database. Only the database's own files include this header.
#pragma once

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "renderer/visibility/movers/mover_shadows.h"
#include "renderer/visibility/movers/shadow_volumes.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// What to do for a light at a patch.
enum class VisibilityDatabase::Work : uint8_t {
  inherit,  // take the entry of the parent
  check,    // keep the entry, except for the effect of the movers
  anew
};

struct VisibilityDatabase::Column {
  int slot = 0;
  bool moversAreAll = true;      // the column waits only for the present movers
  bool moversHidNothing = true;  // no object that it waits for could hide a patch by itself
  // Shadow volumes of the objects that it waits for, before and now. Most columns wait for one
  // object.
  ShadowVolume reach;
  std::vector<ShadowVolume> more;
  std::vector<int> objects;  // objects that it waits for: all their entries are computed
  bool mayFallOn(const vec3& centre, float radius) const {
    return reach.mayFallOn(centre, radius) ||
           std::any_of(more.begin(), more.end(),
                       [&](const ShadowVolume& r) { return r.mayFallOn(centre, radius); });
  }
};

// Columns that wait only for the movers, by slot. Most of their entries are tested many at a time
// (visibility_simple.cpp).
struct VisibilityDatabase::SimpleColumns {
  MoverShadows shadows;
  ShadowVolumes reaches;
  std::vector<const Column*> bySlot;  // null: not a simple column
};

// Keep this small: one step of a drag creates tens of thousands.
struct VisibilityDatabase::Task {
  const Column* column = nullptr;  // null: nothing moved for this light
  int slot = 0;
  int hints = kNone;  // index of the hints found here, or else at the nearest ancestor
  Work work = Work::anew;
  bool isNew = false;
  bool isOfMover = false;  // the column waits for this object
  // The previous entry was not found with its own pyramid, which the parent's does not fully
  // contain.
  bool parentWasNone = false;
  bool isFound = false;                  // the state is known
  bool isSieved = false;                 // no mover can be between light and patch: the entry stays
  Occlusion was = Occlusion::partial;    // the previous entry
  Occlusion state = Occlusion::partial;  // inherit: the parent's entry; afterwards the result
};

// Traverses the patches from the roots and processes all lights at each patch together. So it knows
// whether the patch is divided before it visits the children.
class VisibilityDatabase::Update {
 public:
  // allMayDivide: the division of unchanged patches may change too. `order`: all slots.
  Update(VisibilityDatabase& database, const RenderScene& scene, bool allMayDivide,
         std::span<const int> order, std::atomic<uint64_t>& tests)
      : db_(database), scene_(scene), allMayDivide_(allMayDivide), order_(order), tests_(tests) {
    for (const uint32_t mover : database.movers_)
      moversMayHide_ = moversMayHide_ || database.occluders_.mayHide(mover);
  }

  // Sets the data for testing simple columns; it must outlive this object.
  void useSimple(const SimpleColumns& columns) { simpleColumns_ = &columns; }

  // Processes the root and all patches below it; tasks are ordered by slot. `simple`: one bit per
  // slot, set for simple columns to be tested wherever their shadow volume reaches; or empty.
  void run(uint32_t object, int root, std::span<const Task> tasks,
           std::span<const uint64_t> simple);

 private:
  void visit(uint32_t object, int patch, size_t level, size_t first, bool mayDivide);
  // Simple columns at a patch and at its parts. They return whether any columns remain.
  void checkSimple(uint32_t object, int patch, size_t first, std::span<uint64_t> simple);
  bool passSimpleDown(size_t level, bool wasDivided);
  std::span<uint64_t> simpleAt(size_t level) {
    return std::span(simple_).subspan(level * simpleWords_, simpleWords_);
  }
  void beginParts(uint32_t object, int patch, std::span<const Task> tasks, bool changedBefore);
  void forgetParts(uint32_t object, int patch);
  bool compute(uint32_t object, int patch, std::span<Task> tasks);
  // The blockers that the pyramid of an entry met: among other objects, and among the movers.
  struct Hints {
    Blocker met, metMover;
  };
  class Piece;  // some of the tasks at a patch (visibility_piece.h)
  // Whether the movers cannot change this state, which was found without them.
  bool isDecided(uint8_t others) const {
    return others == static_cast<uint8_t>(Occlusion::full) ||
           (others == static_cast<uint8_t>(Occlusion::partial) && !moversMayHide_);
  }
  // Whether this value of Row::withoutMovers means none, with or without a hint.
  static bool isNone(uint8_t others) {
    return others == static_cast<uint8_t>(Occlusion::none) ||
           (others >= kNoneAndMet && others != kUnknown);
  }
  static MoverShadows::Hint hintOf(uint8_t others) {
    return others >= kNoneAndMet ? static_cast<MoverShadows::Hint>(others - kNoneAndMet)
                                 : MoverShadows::kNoHint;
  }
  static uint8_t noneAndMet(MoverShadows::Hint hint) {
    static_assert(kNoneAndMet + MoverShadows::kHints < kUnknown);
    return static_cast<uint8_t>(kNoneAndMet + hint);
  }
  void passDown(uint32_t object, int patch, int child, bool wasDivided, size_t first, size_t last);

  VisibilityDatabase& db_;
  const RenderScene& scene_;
  const bool allMayDivide_;
  const std::span<const int> order_;
  const SimpleColumns* simpleColumns_ = nullptr;
  size_t levels_ = 0;  // of the root's tree that may have entries
  bool moversMayHide_ = false;
  std::atomic<uint64_t>& tests_;
  std::vector<Task> tasks_;   // a stack; the last are those of the visited patch
  std::vector<Hints> hints_;  // indexed by Task::hints
  size_t simpleWords_ = 0;
  std::vector<uint64_t> simple_;  // one bit per level and slot
};

}  // namespace lamplighter
