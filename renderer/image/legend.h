// A picture whose colours represent values, with their meaning.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/image/image.h"

namespace lamplighter {

// The meaning of a picture's colours. All are display colours.
struct Legend {
  struct Swatch {
    vec3 colour{0.0f};
    std::string label;
  };
  std::string title;
  std::vector<Swatch> swatches;
  std::vector<vec3> ramp;  // evenly spaced from `low` to `high`; empty: no ramp
  std::string low, high;
  // Labels at positions of the ramp, from 0 to 1, in addition to `low` and `high` or instead of
  // them.
  std::vector<std::pair<float, std::string>> ticks;

  bool empty() const { return swatches.empty() && ramp.empty(); }
};

struct ViewPicture {
  Image8 image;  // display colours
  Legend legend;
  // why the view cannot be made, so that `image` is the flat view instead; "": no problem
  std::string problem;
};

}  // namespace lamplighter
