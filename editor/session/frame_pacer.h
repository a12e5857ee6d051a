// Renders frames of a session with the budgets of the editor's window.
#pragma once

#include "editor/budgets/frame_pace.h"

namespace lamplighter {

class Session;

class FramePacer {
 public:
  void renderFrame(Session& session);

 private:
  FramePace pace_;
};

}  // namespace lamplighter
