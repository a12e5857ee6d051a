#include "editor/input/player.h"

#include "renderer/base/error.h"

namespace lamplighter {

Player::Player(Recording recording, int patience)
    : recording_(std::move(recording)), patience_(patience) {}

bool Player::isDue(size_t line) const {
  return line < recording_.lines.size() && recording_.lines[line].frame <= frame_;
}

std::vector<InputEvent> Player::beginFrame() {
  std::vector<InputEvent> events;
  // Events after a checkpoint in the same frame wait until it is reached.
  while (isDue(next_)) {
    const auto* event = std::get_if<InputEvent>(&recording_.lines[next_].what);
    if (event == nullptr) break;
    events.push_back(*event);
    ++next_;
  }
  return events;
}

bool Player::waits() const {
  return isDue(next_) && std::holds_alternative<Checkpoint>(recording_.lines[next_].what);
}

std::vector<Checkpoint> Player::endFrame(bool settled) {
  std::vector<Checkpoint> reached;
  while (isDue(next_)) {
    const auto* checkpoint = std::get_if<Checkpoint>(&recording_.lines[next_].what);
    // events of this frame are left, so the clock does not advance
    if (checkpoint == nullptr) return reached;
    if (!settled) {
      if (++waited_ > patience_) {
        throw InputError(recording_.path.string(),
                         "checkpoint '" + checkpoint->name + "' does not settle within " +
                             std::to_string(patience_) + " frames",
                         "find out what still changes there");
      }
      return reached;
    }
    reached.push_back(*checkpoint);
    waited_ = 0;
    ++next_;
  }
  ++frame_;
  return reached;
}

}  // namespace lamplighter
