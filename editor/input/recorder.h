// Writes what a hand does, as it happens: each frame's lines are flushed, so that a crash loses
// none.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "editor/input/recording.h"

namespace lamplighter {

class Recorder {
 public:
  // Begins the file; throws InputError when it cannot be written.
  Recorder(std::filesystem::path path, const RecordingHeader& header);

  // The events of one frame, with their targets named. Of pointer events in a row the last one
  // counts. Throws InputError when they cannot be written.
  void frame(const std::vector<InputEvent>& events);
  void checkpoint(const Checkpoint& checkpoint);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  uint32_t frame_ = 0;
};

}  // namespace lamplighter
