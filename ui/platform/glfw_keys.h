// GLFW's key codes as ours.
#pragma once

#include "editor/input/event.h"

namespace lamplighter {

Key keyOfGlfw(int glfwKey);  // Key::none for keys that nothing is bound to

}  // namespace lamplighter
