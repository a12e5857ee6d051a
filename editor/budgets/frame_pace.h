// How much work a frame in the editor's window may do.
#pragma once

#include <optional>

#include "renderer/methods/frame_time_control.h"

namespace lamplighter {

// Each frame does as much work as fits into the parameter `frame_time`, by the measured times of
// earlier frames, and at most the parameter `updates`. At rest the same time refines the picture.
// No frame waits for work in the background. The stages of the renderer must be measured.
class FramePace {
 public:
  struct Frame {
    std::optional<int> updates;  // replaces the parameter of that name
    FrameBudget budget;
  };
  Frame next(const Settings& settings);
  // Call after the frame was rendered.
  void measured(const GiStats& stats) { control_.measured(stats); }

 private:
  FrameTimeControl control_;
};

}  // namespace lamplighter
