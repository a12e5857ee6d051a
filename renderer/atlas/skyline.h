// Packs rectangles into a page. Each is placed as low as possible, then as far left as possible
// (the skyline heuristic: Jylänki, "A Thousand Ways to Pack the Bin", 2010, section 5).
#pragma once

#include <optional>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

class Skyline {
 public:
  explicit Skyline(int side) : side_(side), spans_{{0, 0, side}} {}

  // Returns the corner of the rectangle that is nearest the origin. If the rectangle does not fit,
  // returns nothing and changes nothing.
  std::optional<glm::ivec2> place(glm::ivec2 size);

 private:
  struct Span {
    int x, y, width;  // between x and x + width, everything below y is occupied
  };
  int side_;
  std::vector<Span> spans_;  // adjacent, ordered by x
};

}  // namespace lamplighter
