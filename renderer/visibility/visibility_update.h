// How columns of the visibility database are brought up to date; its own files only include this.
#pragma once

#include <algorithm>
#include <atomic>
#include <span>
#include <vector>

#include "renderer/visibility/movers/mover_shadows.h"
#include "renderer/visibility/movers/shadow_volumes.h"
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
  ShadowVolume reach;
  std::vector<ShadowVolume> more;
  std::vector<int> objects;  // that it waits for: all their entries
  bool mayFallOn(const vec3& centre, float radius) const {
    return reach.mayFallOn(centre, radius) ||
           std::any_of(more.begin(), more.end(),
                       [&](const ShadowVolume& r) { return r.mayFallOn(centre, radius); });
  }
};

// Columns that wait for the movers alone, by slot: most of their entries are checked many at a time
// (visibility_simple.cpp).
struct VisibilityDatabase::SimpleColumns {
  MoverShadows shadows;
  ShadowVolumes reaches;
  std::vector<const Column*> bySlot;  // null: it is not simple
};

// Small: a step of a drag passes down tens of thousands.
struct VisibilityDatabase::Task {
  const Column* column = nullptr;  // null: that of a light of which nothing moved
  int slot = 0;
  int hints = kNone;  // index of those found here, or else at the nearest patch above
  Work work = Work::anew;
  bool isNew = false;
  bool isOfMover = false;  // the column waits for the object
  // The entry before was not found by its own pyramid, which is not quite in that of the parent.
  bool parentWasNone = false;
  bool isFound = false;                  // the state is known
  bool isSieved = false;                 // nothing that moved can be between: it stays
  Occlusion was = Occlusion::partial;    // the entry before
  Occlusion state = Occlusion::partial;  // inherit: the parent's; afterwards the entry
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

  // What simple columns are checked by; it must outlive this.
  void useSimple(const SimpleColumns& columns) { simpleColumns_ = &columns; }

  // The root and all below it; tasks in the order of slots. `simple`: besides, a bit for each slot
  // of a simple column that is to be checked there if its shadow may fall there, or empty.
  void run(uint32_t object, int root, std::span<const Task> tasks,
           std::span<const uint64_t> simple);

 private:
  void visit(uint32_t object, int patch, size_t level, size_t first, bool mayDivide);
  // Simple columns at a patch, and at a part of it; whether any are left there.
  void checkSimple(uint32_t object, int patch, size_t first, std::span<uint64_t> simple);
  bool passSimpleDown(size_t level, bool wasDivided);
  std::span<uint64_t> simpleAt(size_t level) {
    return std::span(simple_).subspan(level * simpleWords_, simpleWords_);
  }
  void beginParts(uint32_t object, int patch, std::span<const Task> tasks, bool changedBefore);
  void forgetParts(uint32_t object, int patch);
  bool compute(uint32_t object, int patch, std::span<Task> tasks);
  // What an entry's pyramid met: of all but the movers, and of these.
  struct Hints {
    Blocker met, metMover;
  };
  class Piece;  // some of the tasks at a patch (visibility_piece.h)
  // Whether no mover makes a difference where this is the state by all others.
  bool isDecided(uint8_t others) const {
    return others == static_cast<uint8_t>(Occlusion::full) ||
           (others == static_cast<uint8_t>(Occlusion::partial) && !moversMayHide_);
  }
  // Whether Row::withoutMovers says none, with a hint or without.
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
  bool moversMayHide_ = false;
  std::atomic<uint64_t>& tests_;
  std::vector<Task> tasks_;   // those of the patch that is visited are the last
  std::vector<Hints> hints_;  // by task; those that Task::hints tells of
  size_t simpleWords_ = 0;
  std::vector<uint64_t> simple_;  // by level and slot, a bit each
};

}  // namespace lamplighter
