#include "editor/input/event.h"

#include <array>
#include <string_view>

namespace lamplighter {

namespace {

constexpr std::array<std::string_view, static_cast<size_t>(Key::count)> kNames = {
    "none",   "a",     "b",     "c",     "d",      "e",       "f",         "g",         "h",
    "i",      "j",     "k",     "l",     "m",      "n",       "o",         "p",         "q",
    "r",      "s",     "t",     "u",     "v",      "w",       "x",         "y",         "z",
    "0",      "1",     "2",     "3",     "4",      "5",       "6",         "7",         "8",
    "9",      "f1",    "f2",    "f3",    "f4",     "f5",      "f6",        "f7",        "f8",
    "f9",     "f10",   "f11",   "f12",   "escape", "enter",   "tab",       "backspace", "insert",
    "delete", "left",  "right", "up",    "down",   "page_up", "page_down", "home",      "end",
    "space",  "minus", "equal", "comma", "period", "slash",   "shift",     "ctrl",      "alt",
    "super"};

}  // namespace

std::string keyName(Key key) { return std::string(kNames[static_cast<size_t>(key)]); }

Key keyOf(const std::string& name) {
  for (size_t i = 1; i < kNames.size(); ++i) {
    if (kNames[i] == name) return static_cast<Key>(i);
  }
  return Key::none;
}

}  // namespace lamplighter
