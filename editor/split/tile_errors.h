// The errors of the pictures of tiles against one of them.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/backends/radiance_image.h"

namespace lamplighter {

// The relRMSE of means of 4 × 4 pixels, which reduces the noise of the reference.
double tileError(const Image& picture, const Image& base);

class TileErrors {
 public:
  using Picture = std::shared_ptr<RadianceImage>;
  // Compares new pictures, or all if `base` is new. Null: there is no picture yet. Pictures on a
  // GPU are skipped unless `waits`.
  void update(std::span<const Picture> pictures, size_t base, bool waits);
  // tileError(); none: not compared, or the base itself.
  std::optional<double> of(size_t tile) const;

 private:
  std::vector<Picture> compared_;
  std::vector<std::optional<double>> errors_;
  Picture base_;
};

}  // namespace lamplighter
