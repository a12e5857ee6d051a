#include "ui/platform/glfw_keys.h"

#include <utility>

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

namespace lamplighter {
namespace {

constexpr std::pair<int, Key> kNamedKeys[] = {{GLFW_KEY_ESCAPE, Key::escape},
                                              {GLFW_KEY_ENTER, Key::enter},
                                              {GLFW_KEY_KP_ENTER, Key::enter},
                                              {GLFW_KEY_TAB, Key::tab},
                                              {GLFW_KEY_BACKSPACE, Key::backspace},
                                              {GLFW_KEY_INSERT, Key::insert},
                                              {GLFW_KEY_DELETE, Key::del},
                                              {GLFW_KEY_LEFT, Key::left},
                                              {GLFW_KEY_RIGHT, Key::right},
                                              {GLFW_KEY_UP, Key::up},
                                              {GLFW_KEY_DOWN, Key::down},
                                              {GLFW_KEY_PAGE_UP, Key::pageUp},
                                              {GLFW_KEY_PAGE_DOWN, Key::pageDown},
                                              {GLFW_KEY_HOME, Key::home},
                                              {GLFW_KEY_END, Key::end},
                                              {GLFW_KEY_SPACE, Key::space},
                                              {GLFW_KEY_MINUS, Key::minus},
                                              {GLFW_KEY_KP_SUBTRACT, Key::minus},
                                              {GLFW_KEY_EQUAL, Key::equal},
                                              {GLFW_KEY_COMMA, Key::comma},
                                              {GLFW_KEY_PERIOD, Key::period},
                                              {GLFW_KEY_KP_DECIMAL, Key::period},
                                              {GLFW_KEY_SLASH, Key::slash},
                                              {GLFW_KEY_KP_DIVIDE, Key::slash},
                                              {GLFW_KEY_LEFT_SHIFT, Key::shift},
                                              {GLFW_KEY_RIGHT_SHIFT, Key::shift},
                                              {GLFW_KEY_LEFT_CONTROL, Key::ctrl},
                                              {GLFW_KEY_RIGHT_CONTROL, Key::ctrl},
                                              {GLFW_KEY_LEFT_ALT, Key::alt},
                                              {GLFW_KEY_RIGHT_ALT, Key::alt},
                                              {GLFW_KEY_LEFT_SUPER, Key::super},
                                              {GLFW_KEY_RIGHT_SUPER, Key::super}};

Key offset(Key first, int by) { return static_cast<Key>(static_cast<int>(first) + by); }

}  // namespace

Key keyOfGlfw(int key) {
  if (key >= GLFW_KEY_A && key <= GLFW_KEY_Z) return offset(Key::a, key - GLFW_KEY_A);
  if (key >= GLFW_KEY_0 && key <= GLFW_KEY_9) return offset(Key::n0, key - GLFW_KEY_0);
  if (key >= GLFW_KEY_KP_0 && key <= GLFW_KEY_KP_9) return offset(Key::n0, key - GLFW_KEY_KP_0);
  if (key >= GLFW_KEY_F1 && key <= GLFW_KEY_F12) return offset(Key::f1, key - GLFW_KEY_F1);
  for (const auto& [glfw, ours] : kNamedKeys)
    if (glfw == key) return ours;
  return Key::none;
}

}  // namespace lamplighter
