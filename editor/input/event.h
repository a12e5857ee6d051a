// Input events as data. The platform (ui/platform) and recordings (player.h) put them into the same
// queue. Code behind the queue cannot tell them apart.
#pragma once

#include <cstdint>
#include <string>

#include "renderer/base/math.h"

namespace lamplighter {

enum class EventKind : uint8_t { pointer, button, wheel, key, text, action };

// Recordings contain these names: letters and digits as themselves, others as listed in event.cpp.
enum class Key : uint8_t {
  none,
  a,
  b,
  c,
  d,
  e,
  f,
  g,
  h,
  i,
  j,
  k,
  l,
  m,
  n,
  o,
  p,
  q,
  r,
  s,
  t,
  u,
  v,
  w,
  x,
  y,
  z,
  n0,
  n1,
  n2,
  n3,
  n4,
  n5,
  n6,
  n7,
  n8,
  n9,
  f1,
  f2,
  f3,
  f4,
  f5,
  f6,
  f7,
  f8,
  f9,
  f10,
  f11,
  f12,
  escape,
  enter,
  tab,
  backspace,
  insert,
  del,
  left,
  right,
  up,
  down,
  pageUp,
  pageDown,
  home,
  end,
  space,
  minus,
  equal,
  comma,
  period,
  slash,
  shift,
  ctrl,
  alt,
  super,
  count
};

struct Modifiers {
  bool ctrl = false, shift = false, alt = false;
  bool operator==(const Modifiers&) const = default;
};

struct InputEvent {
  EventKind kind = EventKind::pointer;
  // pointer: the new position. `target` gives its coordinate space: "" the window [px], "viewport"
  // the 3D view [px], otherwise the registered name of a widget, with x and y in [0, 1] across it.
  std::string target;
  vec2 position{0.0f};
  int button = 0;     // 0 left, 1 right, 2 middle
  bool down = false;  // button, key
  vec2 wheel{0.0f};   // notches
  Key key = Key::none;
  std::string text;  // text: UTF-8; action: the action's text, "light.add rectangle"
  bool operator==(const InputEvent&) const = default;
};

std::string keyName(Key key);
Key keyOf(const std::string& name);  // Key::none if the name is unknown

}  // namespace lamplighter
