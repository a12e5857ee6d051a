// Packs rectangles into a page, each as low as it can lie and then as far left (the skyline
// heuristic: Jylänki, "A Thousand Ways to Pack the Bin", 2010, section 5).
#pragma once

#include <optional>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

class Skyline {
 public:
  explicit Skyline(int side) : side_(side), spans_{{0, 0, side}} {}

  // Where the rectangle's corner nearest the origin lies; nothing, and no change, where it does not
  // fit.
  std::optional<glm::ivec2> place(glm::ivec2 size);

 private:
  struct Span {
    int x, y, width;  // from x on everything below y is taken
  };
  int side_;
  std::vector<Span> spans_;  // side by side
};

}  // namespace lamplighter
