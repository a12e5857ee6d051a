// Hands out a recording's events, frame by frame.
#pragma once

#include "editor/input/recording.h"

namespace lamplighter {

class Player {
 public:
  // `patience`: frames that a checkpoint may wait for the picture to settle.
  explicit Player(Recording recording, int patience = 20000);

  const Recording& recording() const { return recording_; }
  uint32_t frame() const { return frame_; }
  bool finished() const { return next_ == recording_.lines.size(); }

  // Before a frame: its events. None while a checkpoint waits.
  std::vector<InputEvent> beginFrame();
  // Whether a checkpoint waits for this frame's picture.
  bool waits() const;
  // After it: the checkpoints that are reached now, once each; the clock goes on when none waits.
  // Throws InputError when one has waited too long.
  std::vector<Checkpoint> endFrame(bool settled);

 private:
  bool isDue(size_t line) const;

  Recording recording_;
  int patience_, waited_ = 0;
  uint32_t frame_ = 0;
  size_t next_ = 0;
};

}  // namespace lamplighter
