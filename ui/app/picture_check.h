// Compares the pictures of a replay with its baselines.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/image/image.h"

namespace lamplighter {

struct PictureDifference {
  bool sameSize = true;
  int max = 0;  // largest difference of a channel, of 255
  // the same without the worst 0.1% of the pixels: silhouettes differ between rasterizer and ray
  // tracer, and between rasterizers
  int largest = 0;
  double mean = 0.0;  // over pixels and channels, of 255
  // largest mean of a tile of 16 x 16 pixels; detects a missing word or icon, which hardly changes
  // the mean of the whole picture
  double tile = 0.0;
  size_t pixels = 0;  // pixels that differ

  bool none() const { return sameSize && max == 0; }
  bool within(double mostLargest, double mostMean) const {
    return sameSize && largest <= mostLargest && mean <= mostMean;
  }
  std::string text() const;
};

// The picture at half width and half height. Each pixel is the mean of up to four. Baselines have
// this size.
Image8 halved(const Image8& image);
// Compares display-referred pictures without alpha.
PictureDifference comparePictures(const Image8& a, const Image8& b);
// The difference as a picture: black is equal; the colours go through red to white, which means
// that a channel differs by 64 of 255 or more. Both pictures must have the same size.
Image8 differencePicture(const Image8& a, const Image8& b);
// Reads a picture without any colour conversion. Throws InputError.
Image8 readPicture(const std::filesystem::path& path);

}  // namespace lamplighter
