#include "renderer/path_repair/coarse_preview.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// A picture has about this number of blocks, which are at most kMostSide pixels wide.
constexpr float kBlocks = 64000.0f;
constexpr int kMostSide = 4;
// Added to the weight of each block around a pixel: if the pixel is in the middle of a block that
// shows a lamp, the others count.
constexpr float kLeastShare = 0.01f;
// If the weights of the blocks that show the surface of a pixel sum to less than this, none does.
constexpr float kLeastWeight = 1e-4f;
// A pixel whose surface no block around it shows is scaled like these, at most by this factor.
constexpr float kMostScale = 4.0f;

}  // namespace

int CoarsePreview::sideOf(int width, int height) {
  const float pixels = static_cast<float>(width) * static_cast<float>(height);
  return std::clamp(static_cast<int>(std::lround(std::sqrt(pixels / kBlocks))), 1, kMostSide);
}

CoarsePreview::CoarsePreview(const RepairGuides& pixels, int side)
    : pixels_(pixels),
      side_(side),
      blocks_(pixels.inBlocks(side)),
      sums_(blocks_.width, blocks_.height) {}

void CoarsePreview::endPaths() {
  sums_.endPath();
  sums_.endPath();
}

// Visits all pixels of a block; consecutive ones are far apart. 7 has no common divisor with 4, 9
// and 16.
glm::ivec2 CoarsePreview::pixelOf(int path) const {
  const int pixel = (7 * path + side_ / 2 * (side_ + 1)) % (side_ * side_);
  return {pixel % side_, pixel / side_};
}

void CoarsePreview::beginFilter(const std::shared_ptr<RadianceImage>& live) {
  live_ = live;
  means_ = meansOf(live->pixels());
  filter_ = std::make_unique<ResidualFilter>(blocks_, means_, sums_);
}

// Averages the pixels that have paths: with all pixels, texture would count as an error of the
// picture. Blocks at the sky or a lamp have no paths; their mean is 0, too.
Image CoarsePreview::meansOf(const Image& picture) const {
  Image means(blocks_.width, blocks_.height);
  tbb::parallel_for(0, blocks_.height, [&](int y) {
    for (int x = 0; x < blocks_.width; ++x) {
      if (blocks_.isAtLight(x, y)) continue;
      vec3 sum(0.0f);
      for (int path = 0; path < traced(); ++path) {
        const glm::ivec2 at = pixelOf(path);
        sum += picture.at(std::min(side_ * x + at.x, picture.width - 1),
                          std::min(side_ * y + at.y, picture.height - 1));
      }
      means.at(x, y) = sum / static_cast<float>(traced());
    }
  });
  return means;
}

int CoarsePreview::filter(int mostRows) {
  const int rows = filter_->step(mostRows);
  if (!filter_->isDone()) return rows;
  const Image residual = filter_->takeResidual();
  filter_.reset();
  show(residual);
  return rows;
}

void CoarsePreview::show(const Image& residual) {
  Image out = live_->pixels();
  tbb::parallel_for(0, pixels_.height, [&](int y) {
    for (int x = 0; x < pixels_.width; ++x)
      if (!pixels_.isAtLight(x, y))
        out.at(x, y) = glm::max(out.at(x, y) + residualAt(residual, x, y), vec3(0.0f));
  });
  image_ = std::make_shared<HostImage>(std::move(out));
}

// The residual of a pixel from the four blocks around it: of those that show its surface, by
// albedo; if there are none, by the share of light that all of them lack.
vec3 CoarsePreview::residualAt(const Image& residual, int x, int y) const {
  const auto i = static_cast<size_t>(y * pixels_.width + x);
  const vec3 normal = pixels_.normal[i], position = pixels_.position[i];
  const float tolerance = 1.0f / (pixels_.footprint[i] * static_cast<float>(side_));
  const float across = (static_cast<float>(x) + 0.5f) / static_cast<float>(side_) - 0.5f,
              down = (static_cast<float>(y) + 0.5f) / static_cast<float>(side_) - 0.5f;
  const float left = std::floor(across), top = std::floor(down);
  vec3 alike(0.0f), all(0.0f), light(0.0f);
  float weights = 0.0f;
  for (int k = 0; k < 4; ++k) {
    const int dx = k % 2, dy = k / 2;
    const int u = std::clamp(static_cast<int>(left) + dx, 0, blocks_.width - 1),
              v = std::clamp(static_cast<int>(top) + dy, 0, blocks_.height - 1);
    if (blocks_.isAtLight(u, v)) continue;
    const auto b = static_cast<size_t>(v * blocks_.width + u);
    const float weight = kLeastShare + std::abs(1.0f - static_cast<float>(dx) - (across - left)) *
                                           std::abs(1.0f - static_cast<float>(dy) - (down - top));
    all += weight * residual.pixels[b];
    light += weight * means_.pixels[b];
    float turn = std::max(glm::dot(normal, blocks_.normal[b]), 0.0f);
    for (int power = 1; power < 8; power *= 2) turn *= turn;
    const float off = glm::dot(normal, blocks_.position[b] - position) * tolerance;
    const float same = weight * turn * std::max(1.0f - off * off, 0.0f);
    alike += same * residual.pixels[b] / blocks_.albedo[b];
    weights += same;
  }
  if (weights > kLeastWeight) return pixels_.albedo[i] * alike / weights;
  const vec3 scale = all / glm::max(light, vec3(1e-6f));
  return glm::clamp(scale, vec3(-1.0f), vec3(kMostScale - 1.0f)) * live_->pixels().pixels[i];
}

}  // namespace lamplighter
