#include "renderer/visibility/visibility_piece.h"

#include <algorithm>

#include "renderer/scene/light_linking.h"
#include "renderer/visibility/occlusion/back_facing_lights.h"

namespace lamplighter {

bool VisibilityDatabase::Update::Piece::run(std::span<Task> tasks) {
  for (Task& t : tasks) {
    const auto slot = static_cast<size_t>(t.slot);
    t.was = static_cast<Occlusion>(row_.states[slot]);
    uint8_t others = keepsOthers_ && !t.isNew ? row_.withoutMovers[slot] : kUnknown;
    if (!row_.standsTill.empty()) row_.standsTill[slot] = 0;
    bool isSettled = true;
    if (leftOutBy_ != 0 &&
        isLeftOut(leftOutBy_, static_cast<uint32_t>(db_.lights_[slot].footprint.y))) {
      t.state = Occlusion::full;
      others = static_cast<uint8_t>(Occlusion::full);
    } else if (t.work != Work::inherit) {
      isSettled = settle(t, others);
    }
    if (isSettled) {
      keep(t, others);
      take(t);
    } else if (others != kUnknown || !mayBeTogether(t)) {
      checkAlone(t, others);
    } else {
      unknown_[unknownCount_++] = &t;
      if (unknownCount_ == kTogether) findSides();
      if (openCount_ >= kTogether) findOthers();
    }
  }
  if (unknownCount_ + openCount_ < kWorthTogether) {
    for (size_t i = 0; i < unknownCount_; ++i) checkAlone(*unknown_[i], kUnknown);
    unknownCount_ = 0;
  }
  if (unknownCount_ > 0) findSides();
  while (openCount_ > 0) findOthers();
  if (tests_ > 0) update_.tests_ += tests_;
  return changed_;
}

// Table 4-1: if no mover can be between light and patch, before or now, no test is done. Returns
// whether this, or a known state, decides the entry.
bool VisibilityDatabase::Update::Piece::settle(Task& task, uint8_t& others) const {
  const auto is = [&](Occlusion state) {
    task.state = state;
    return true;
  };
  task.isSieved = false;
  if (task.isFound) return true;
  if (others == static_cast<uint8_t>(Occlusion::full)) return is(Occlusion::full);
  const bool wasFound = task.work == Work::check && !task.isOfMover && !task.parentWasNone;
  task.isSieved = wasFound && !task.column->mayFallOn(patch_.centre, patch_.radius);
  if (task.isSieved) return is(task.was);
  // If the patch was hidden, and not by the movers, then other objects hide it.
  if (wasFound && others == kUnknown && task.was == Occlusion::full && task.column->moversAreAll &&
      task.column->moversHidNothing) {
    others = static_cast<uint8_t>(Occlusion::full);
    return is(Occlusion::full);
  }
  if (update_.isDecided(others)) return is(static_cast<Occlusion>(others));
  // If nothing was between light and patch, only the movers can be.
  if (others == kUnknown && wasFound && task.column->moversAreAll && task.was == Occlusion::none)
    others = static_cast<uint8_t>(Occlusion::none);
  return false;
}

void VisibilityDatabase::Update::Piece::findSides() {
  std::array<PyramidApex, kTogether> apices;
  std::array<const PyramidApex*, kTogether> lights;
  for (size_t i = 0; i < unknownCount_; ++i) {
    apices[i] = PyramidApex(lightOf(*unknown_[i]));
    lights[i] = &apices[i];
  }
  const BackFacingLights sides(lanesOf(LightPacket({lights.data(), unknownCount_}), region_),
                               region_);
  for (size_t i = 0; i < unknownCount_; ++i) {
    Task& task = *unknown_[i];
    if ((sides.dark >> i & 1) != 0) {
      finish(task, static_cast<uint8_t>(Occlusion::full));
      continue;
    }
    ++tests_;
    if ((sides.degenerate >> i & 1) != 0) {
      finish(task, static_cast<uint8_t>(Occlusion::partial));
    } else {
      open_[openCount_++] = &task;
    }
  }
  unknownCount_ = 0;
}

void VisibilityDatabase::Update::Piece::findOthers() {
  const size_t count = std::min(openCount_, kTogether);
  std::array<const shared::Vpl*, kTogether> lights;
  std::array<Hints, kTogether> hints;
  std::array<Blocker, kTogether> met;
  for (size_t i = 0; i < count; ++i) {
    lights[i] = &lightOf(*open_[i]);
    hints[i] = hintsFor(*open_[i]);
    met[i] = hints[i].met;
  }
  const Occluders::States states = db_.occluders_.occlusionsWithout(
      update_.scene_, {{lights.data(), count}, region_}, db_.movers_, {met.data(), count});
  for (size_t i = 0; i < count; ++i) {
    hints[i].met = met[i];
    keep(*open_[i], hints[i]);
    finish(*open_[i], static_cast<uint8_t>(states[i]));
  }
  std::copy(open_.begin() + static_cast<ptrdiff_t>(count),
            open_.begin() + static_cast<ptrdiff_t>(openCount_), open_.begin());
  openCount_ -= count;
}

void VisibilityDatabase::Update::Piece::finish(Task& task, uint8_t others) {
  // If the pyramid meets no mover, the state does not change either.
  if (!update_.isDecided(others) && !db_.movers_.empty()) {
    checkAlone(task, others);
    return;
  }
  task.state = static_cast<Occlusion>(others);
  keep(task, others);
  take(task);
}

void VisibilityDatabase::Update::Piece::checkAlone(Task& task, uint8_t others) {
  const OcclusionPyramid pyramid(lightOf(task), region_);
  const Occluders& occluders = db_.occluders_;
  Hints hints = hintsFor(task);
  if (others == kUnknown) {
    if (!pyramid.isDark()) ++tests_;
    others = static_cast<uint8_t>(
        occluders.occlusionWithout(update_.scene_, pyramid, db_.movers_, hints.met));
  }
  task.state = isNone(others) ? Occlusion::none : static_cast<Occlusion>(others);
  if (!update_.isDecided(others))
    task.state = std::max(
        task.state, occluders.occlusionBy(update_.scene_, pyramid, db_.movers_, hints.metMover));
  keep(task, hints);
  keep(task, others);
  take(task);
}

VisibilityDatabase::Update::Hints VisibilityDatabase::Update::Piece::hintsFor(
    const Task& task) const {
  Hints hints = task.hints == kNone ? Hints() : update_.hints_[static_cast<size_t>(task.hints)];
  if (hints.met.object == kNone) hints.met = before_.met;
  if (hints.metMover.object == kNone) hints.metMover = before_.metMover;
  return hints;
}

void VisibilityDatabase::Update::Piece::keep(Task& task, const Hints& hints) {
  task.hints = static_cast<int>(&task - update_.tasks_.data());
  update_.hints_[static_cast<size_t>(task.hints)] = before_ = hints;
}

}  // namespace lamplighter
