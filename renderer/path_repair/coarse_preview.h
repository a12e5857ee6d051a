// A first repair of a picture, by less than a path for each pixel.
#pragma once

#include <memory>

#include "renderer/backends/radiance_image.h"
#include "renderer/path_repair/path_sums.h"
#include "renderer/path_repair/repair_guides.h"
#include "renderer/path_repair/residual_filter.h"

namespace lamplighter {

// The error of an early picture is mostly smooth. So the first paths of some pixels count as paths
// of blocks of k × k pixels, ResidualFilter runs on blocks, and the residual is interpolated
// between blocks that show the same surface. The sky, lamps and pixels beside them are not changed.
class CoarsePreview {
 public:
  // The side of a block [pixels]; 1: the picture is so small that it needs no preview in blocks.
  static int sideOf(int width, int height);

  // `pixels` must outlive this object.
  CoarsePreview(const RepairGuides& pixels, int side);
  CoarsePreview(const CoarsePreview&) = delete;
  CoarsePreview& operator=(const CoarsePreview&) = delete;

  int side() const { return side_; }
  const RepairGuides& blocks() const { return blocks_; }
  // The number of pixels of each block that have a path in each half.
  int traced() const { return sums_.paths / 2; }
  // The position in its block of the next pixel; the first is in the middle.
  glm::ivec2 nextPixel() const { return pixelOf(traced()); }
  // Adds a path to a half of a block. Not for blocks at the sky or a lamp.
  void add(bool isFirst, size_t block, const vec3& radiance) {
    sums_.add(isFirst, block, radiance);
  }
  // Call after each block got a path in both halves.
  void endPaths();

  void beginFilter(const std::shared_ptr<RadianceImage>& live);
  void dropFilter() { filter_.reset(); }
  bool isFiltering() const { return filter_ != nullptr; }
  // Filters at most this number of rows of a step; returns how many. The last call renews image().
  int filter(int mostRows);
  // The repaired picture; null until there is one.
  const std::shared_ptr<RadianceImage>& image() const { return image_; }

 private:
  glm::ivec2 pixelOf(int path) const;
  Image meansOf(const Image& picture) const;
  void show(const Image& residual);
  vec3 residualAt(const Image& residual, int x, int y) const;

  const RepairGuides& pixels_;
  int side_;
  RepairGuides blocks_;
  PathSums sums_;
  std::shared_ptr<RadianceImage> live_;  // of the filter
  Image means_;                          // mean of the traced pixels of live_, by block
  std::unique_ptr<ResidualFilter> filter_;
  std::shared_ptr<RadianceImage> image_;
};

}  // namespace lamplighter
