// Some of the lights at one patch, the work of one thread; the database's own files only include
// this.
#pragma once

#include <array>
#include <span>

#include "renderer/visibility/visibility_update.h"

namespace lamplighter {

class VisibilityDatabase::Update::Piece {
 public:
  // `leftOutBy`: of the object.
  Piece(Update& update, uint32_t leftOutBy, const Patch& patch, const PatchRegion& region, Row& row,
        bool keepsOthers)
      : update_(update),
        db_(update.db_),
        leftOutBy_(leftOutBy),
        patch_(patch),
        region_(region),
        row_(row),
        keepsOthers_(keepsOthers) {}

  // Whether an entry changed.
  bool run(std::span<Task> tasks);

 private:
  static constexpr size_t kTogether = LightPacket::kLights;
  static constexpr size_t kWorthTogether = 3;  // fewer are quicker alone

  const shared::Vpl& lightOf(const Task& task) const {
    return db_.lights_[static_cast<size_t>(task.slot)];
  }
  // Whether the entry is decided without a pyramid, and how.
  bool settle(Task& task, uint8_t& others) const;
  bool mayBeTogether(const Task& task) const {
    return db_.useClusters_ && lightOf(task).position.w != shared::kVplDirectional;
  }
  // Where nothing is known of all but the movers, many entries are looked at together: first which
  // lights need a pyramid at all, then eight of these at a time.
  void findSides();
  void findOthers();
  // By a pyramid for the light alone.
  void checkAlone(Task& task, uint8_t others);
  void finish(Task& task, uint8_t others);  // what they are is known
  void take(const Task& task) {
    if (task.state == task.was) return;
    row_.states[static_cast<size_t>(task.slot)] = static_cast<uint8_t>(task.state);
    changed_ = true;
  }
  void keep(const Task& task, uint8_t others) {
    if (keepsOthers_) row_.withoutMovers[static_cast<size_t>(task.slot)] = others;
  }
  // What is asked first; then it is kept for the patches below.
  Hints hintsFor(const Task& task) const;
  void keep(Task& task, const Hints& hints);

  Update& update_;
  VisibilityDatabase& db_;
  const uint32_t leftOutBy_;
  const Patch& patch_;
  const PatchRegion& region_;
  Row& row_;
  const bool keepsOthers_;
  bool changed_ = false;
  uint64_t tests_ = 0;
  Hints before_;  // of the light before
  std::array<Task*, kTogether> unknown_;
  std::array<Task*, 2 * kTogether> open_;  // those of them that need a pyramid
  size_t unknownCount_ = 0, openCount_ = 0;
};

}  // namespace lamplighter
