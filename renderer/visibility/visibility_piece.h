// Some of the lights at one patch, processed by one thread. Only the database's own files include
// this header.
#pragma once

#include <array>
#include <span>

#include "renderer/visibility/visibility_update.h"

namespace lamplighter {

class VisibilityDatabase::Update::Piece {
 public:
  // `leftOutBy`: the bits of the object (light_linking.h).
  Piece(Update& update, uint32_t leftOutBy, const Patch& patch, const PatchRegion& region, Row& row,
        bool keepsOthers)
      : update_(update),
        db_(update.db_),
        leftOutBy_(leftOutBy),
        patch_(patch),
        region_(region),
        row_(row),
        keepsOthers_(keepsOthers) {}

  // Computes the entries. Returns whether any changed.
  bool run(std::span<Task> tasks);

 private:
  static constexpr size_t kTogether = LightPacket::kLights;
  static constexpr size_t kWorthTogether = 3;  // fewer are faster one by one

  const shared::Vpl& lightOf(const Task& task) const {
    return db_.lights_[static_cast<size_t>(task.slot)];
  }
  // Decides the entry without a pyramid if possible; returns whether it did.
  bool settle(Task& task, uint8_t& others) const;
  bool mayBeTogether(const Task& task) const {
    return db_.useClusters_ && lightOf(task).position.w != shared::kVplDirectional;
  }
  // If the state without the movers is unknown, many entries are tested together: first findSides()
  // finds the lights that need a pyramid, then these are tested eight at a time.
  void findSides();
  void findOthers();
  // Tests one light with its own pyramid.
  void checkAlone(Task& task, uint8_t others);
  void finish(Task& task, uint8_t others);  // completes the entry; `others` is the state without
                                            // the movers
  void take(const Task& task) {
    if (task.state == task.was) return;
    row_.states[static_cast<size_t>(task.slot)] = static_cast<uint8_t>(task.state);
    changed_ = true;
  }
  void keep(const Task& task, uint8_t others) {
    if (keepsOthers_) row_.withoutMovers[static_cast<size_t>(task.slot)] = others;
  }
  // The blockers to test first; keep() stores them for the patches below.
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
  Hints before_;  // of the previous light
  std::array<Task*, kTogether> unknown_;
  std::array<Task*, 2 * kTogether> open_;  // the elements of unknown_ that need a pyramid
  size_t unknownCount_ = 0, openCount_ = 0;
};

}  // namespace lamplighter
