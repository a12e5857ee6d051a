// Records the user's input. It flushes the lines of each frame, so that a crash loses nothing.
#pragma once

#include <filesystem>
#include <fstream>
#include <vector>

#include "editor/input/recording.h"

namespace lamplighter {

class Recorder {
 public:
  // Creates the file. Throws InputError if it cannot be written.
  Recorder(std::filesystem::path path, const RecordingHeader& header);

  // Writes the events of one frame, with named targets. Of consecutive pointer events it keeps only
  // the last one. Throws InputError if it cannot write.
  void frame(const std::vector<InputEvent>& events);
  void checkpoint(const Checkpoint& checkpoint);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  uint32_t frame_ = 0;
};

}  // namespace lamplighter
