#include "renderer/path_repair/repair_guides.h"

#include <algorithm>
#include <cstdint>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Black surfaces reflect, too: highlights.
constexpr float kLeastAlbedo = 0.04f;

}  // namespace

RepairGuides::RepairGuides(const GBufferView& gbuffer, const View& view, bool white)
    : width(gbuffer.width()), height(gbuffer.height()) {
  const size_t pixels = static_cast<size_t>(width) * static_cast<size_t>(height);
  position.assign(pixels, vec3(0.0f));
  normal.assign(pixels, vec3(0.0f));
  albedo.assign(pixels, vec3(1.0f));
  footprint.assign(pixels, 1.0f);
  const float middle = 0.5f * static_cast<float>(height);
  const float perMetre =
      glm::distance(view.rayDirection(0.5f * static_cast<float>(width), middle + 0.5f),
                    view.rayDirection(0.5f * static_cast<float>(width), middle - 0.5f));
  std::vector<uint8_t> isLight(pixels, 1);
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x)
      if (gbuffer.isHit(x, y) && gbuffer.at(x, y).emission == vec3(0.0f))
        isLight[static_cast<size_t>(y * width + x)] = 0;
  });
  const auto isNearLight = [&](int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, height - 1); ++v)
      for (int u = std::max(x - 1, 0); u <= std::min(x + 1, width - 1); ++u)
        if (isLight[static_cast<size_t>(v * width + u)] != 0) return true;
    return false;
  };
  tbb::parallel_for(0, height, [&](int y) {
    for (int x = 0; x < width; ++x) {
      if (isNearLight(x, y)) continue;
      const GBufferPoint p = gbuffer.at(x, y);
      const auto i = static_cast<size_t>(y * width + x);
      position[i] = p.position;
      normal[i] = p.normal;
      if (!white) albedo[i] = glm::max(p.albedo, vec3(kLeastAlbedo));
      footprint[i] = perMetre * glm::distance(p.position, view.eye);
    }
  });
}

bool RepairGuides::isAtBorder(int x, int y) const {
  constexpr int kReach = 2;
  for (int v = std::max(y - kReach, 0); v <= std::min(y + kReach, height - 1); ++v)
    for (int u = std::max(x - kReach, 0); u <= std::min(x + kReach, width - 1); ++u)
      if (!isAtLight(u, v)) return true;
  return false;
}

RepairGuides RepairGuides::inBlocks(int side) const {
  RepairGuides blocks;
  blocks.width = (width + side - 1) / side;
  blocks.height = (height + side - 1) / side;
  for (int y = 0; y < height; y += side)
    for (int x = 0; x < width; x += side) {
      const int u = std::min(x + side / 2, width - 1), v = std::min(y + side / 2, height - 1);
      const auto middle = static_cast<size_t>(v * width + u);
      vec3 shown = normal[middle];
      for (int below = y; below < std::min(y + side, height); ++below)
        for (int right = x; right < std::min(x + side, width); ++right)
          if (isAtLight(right, below)) shown = vec3(0.0f);
      blocks.normal.push_back(shown);
      blocks.position.push_back(position[middle]);
      blocks.albedo.push_back(albedo[middle]);
      blocks.footprint.push_back(static_cast<float>(side) * footprint[middle]);
    }
  return blocks;
}

}  // namespace lamplighter
