// Returns the events of a recording, frame by frame.
#pragma once

#include "editor/input/recording.h"

namespace lamplighter {

class Player {
 public:
  // `patience`: the maximum number of frames that a checkpoint waits until the picture is settled.
  explicit Player(Recording recording, int patience = 20000);

  const Recording& recording() const { return recording_; }
  uint32_t frame() const { return frame_; }
  bool finished() const { return next_ == recording_.lines.size(); }

  // Call before a frame: returns its events. Returns none while a checkpoint waits.
  std::vector<InputEvent> beginFrame();
  // Whether a checkpoint waits for the picture of this frame.
  bool waits() const;
  // Call after the frame: returns each checkpoint once, when it is reached. The clock advances when
  // no checkpoint waits. Throws InputError if one has waited too long.
  std::vector<Checkpoint> endFrame(bool settled);

 private:
  bool isDue(size_t line) const;

  Recording recording_;
  int patience_, waited_ = 0;
  uint32_t frame_ = 0;
  size_t next_ = 0;
};

}  // namespace lamplighter
