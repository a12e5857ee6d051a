#include "editor/split/heat_map.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "renderer/debug_views/view_colours.h"

namespace lamplighter {
namespace {

// Side of a block in pixels of the larger picture.
int blockOf(int width, int blocks) { return std::max(1, width / std::max(blocks, 1)); }

}  // namespace

Image enlarged(const Image& blocks, int width, int height) {
  const int across = blockOf(width, blocks.width), down = blockOf(height, blocks.height);
  Image large(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      large.at(x, y) =
          blocks.at(std::min(x / across, blocks.width - 1), std::min(y / down, blocks.height - 1));
  return large;
}

ViewPicture heatMapOf(const Image& a, const Image& b, float scale, int width, int height,
                      const std::string& nameOfA, const std::string& nameOfB) {
  double mean = 0.0;
  for (const vec3& p : b.pixels) mean += static_cast<double>(p.r + p.g + p.b) / 3.0;
  mean /= static_cast<double>(std::max<size_t>(b.pixels.size(), 1));
  Image shares(b.width, b.height);
  for (size_t i = 0; i < b.pixels.size(); ++i) {
    const vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    const double most = std::max({d.r, d.g, d.b});
    shares.pixels[i] = vec3(mean > 0.0 ? static_cast<float>(most / mean) : 0.0f);
  }
  shares = enlarged(shares, width, height);
  ViewPicture picture;
  picture.image = Image8(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const vec3 colour = view_colours::ramp(std::min(shares.at(x, y).r / scale, 1.0f));
      for (int c = 0; c < 3; ++c)
        picture.image.at(x, y)[c] = static_cast<uint8_t>(std::lround(255.0f * colour[c]));
    }
  }
  picture.legend.title = "Difference of " + nameOfA + " from " + nameOfB;
  picture.legend.ramp = view_colours::rampSteps();
  picture.legend.low = "0%";
  picture.legend.high = fmt::format("{:.3g}% of the mean", 100.0f * scale);
  return picture;
}

}  // namespace lamplighter
