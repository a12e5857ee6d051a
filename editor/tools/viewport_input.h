// What the tools are told of the pointer and keys in a frame. Never GLFW, never ImGui.
#pragma once

#include <set>

#include "editor/input/event.h"

namespace lamplighter {

struct ViewportInput {
  vec2 pointer{0.0f};     // viewport pixels, y down
  bool hovered = false;   // the pointer is over the viewport and no widget has it
  bool down[3] = {};      // left, right, middle; only presses that began in the viewport count
  bool pressed[3] = {};   // went down this frame
  bool released[3] = {};  // went up this frame
  bool doubleClicked = false;
  float wheel = 0.0f;  // notches this frame
  std::set<Key> keys;  // held, empty while a text field has the keyboard
  Modifiers modifiers;
  float seconds = 1.0f / 60.0f;  // since the last frame, from the session's clock
};

}  // namespace lamplighter
