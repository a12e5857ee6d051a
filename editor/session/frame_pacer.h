// Renders frames of a session with the budgets of the editor's window.
#pragma once

#include "renderer/methods/frame_time_control.h"

namespace lamplighter {

class Session;

// Each frame does as much work as fits into the parameter `frame_time`, by the measured times of
// earlier frames, and at most the parameter `updates`. At rest the same time refines the picture.
// No frame waits for work in the background. The stages of the session's renderer must be measured.
class FramePacer {
 public:
  void renderFrame(Session& session);

 private:
  FrameTimeControl control_;
};

}  // namespace lamplighter
