// Guides of a picture for tests of filters.
#pragma once

#include <algorithm>

#include "renderer/path_repair/repair_guides.h"

namespace lamplighter::test {

// A wall and a floor that meet in the middle row, with checks of two albedos of `check` × `check`
// pixels. A pixel has a side of 1 cm.
inline RepairGuides wallAndFloor(int width, int height, int check) {
  RepairGuides guides;
  guides.width = width;
  guides.height = height;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const int up = height / 2 - y;
      guides.position.emplace_back(0.01f * static_cast<float>(x),
                                   0.01f * static_cast<float>(std::max(up, 0)),
                                   0.01f * static_cast<float>(std::max(-up, 0)));
      guides.normal.push_back(up > 0 ? vec3(0, 0, 1) : vec3(0, 1, 0));
      guides.albedo.emplace_back((x / check + y / check) % 2 == 0 ? 0.8f : 0.2f);
      guides.footprint.push_back(0.01f);
    }
  return guides;
}

}  // namespace lamplighter::test
