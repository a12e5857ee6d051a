// The pointer and keys of one frame, as the tools see them. Independent of GLFW and ImGui.
#pragma once

#include <set>

#include "editor/input/event.h"

namespace lamplighter {

struct ViewportInput {
  vec2 pointer{0.0f};     // viewport pixels, y down
  bool hovered = false;   // the pointer is over the viewport and not over a widget
  bool down[3] = {};      // left, right, middle; only presses that started in the viewport
  bool pressed[3] = {};   // pressed this frame
  bool released[3] = {};  // released this frame
  bool doubleClicked = false;
  float wheel = 0.0f;  // notches this frame
  std::set<Key> keys;  // held keys; empty while a text field has the keyboard
  Modifiers modifiers;
  float seconds = 1.0f / 60.0f;  // since the last frame, by the session's clock
};

}  // namespace lamplighter
