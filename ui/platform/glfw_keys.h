// Converts GLFW's key codes to Key.
#pragma once

#include "editor/input/event.h"

namespace lamplighter {

Key keyOfGlfw(int glfwKey);  // Key::none for keys that cannot be bound

}  // namespace lamplighter
