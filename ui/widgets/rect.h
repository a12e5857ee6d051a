// An axis-aligned rectangle in window pixels, y down.
#pragma once

#include "renderer/base/math.h"

namespace lamplighter {

struct Rect {
  vec2 min{0.0f};
  vec2 max{0.0f};

  vec2 size() const { return max - min; }
  bool empty() const { return max.x <= min.x || max.y <= min.y; }
  bool contains(vec2 p) const { return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y; }
};

}  // namespace lamplighter
