// Comparing a replay's pictures with its baselines.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/image/image.h"

namespace lamplighter {

struct PictureDifference {
  bool sameSize = true;
  int max = 0;        // of a channel, of 255
  int largest = 0;    // the same with one pixel in a thousand left out: silhouettes, which differ
                      // between a rasterizer and rays, and between rasterizers
  double mean = 0.0;  // over pixels and channels, of 255
  double tile = 0.0;  // the largest mean of a tile of 16 x 16 pixels: a word or an icon that is not
                      // there, which would be lost in the mean
  size_t pixels = 0;  // that differ at all

  bool none() const { return sameSize && max == 0; }
  bool within(double mostLargest, double mostMean) const {
    return sameSize && largest <= mostLargest && mean <= mostMean;
  }
  std::string text() const;
};

// Half the size each way, every pixel the mean of up to four. Baselines are kept this way.
Image8 halved(const Image8& image);
// Display-referred pictures, alpha aside.
PictureDifference comparePictures(const Image8& a, const Image8& b);
// Where they differ: black is equal, through red to white where a channel is 64 of 255 off or more.
// Both of one size.
Image8 differencePicture(const Image8& a, const Image8& b);
// A picture as it was written, without any conversion. Throws InputError.
Image8 readPicture(const std::filesystem::path& path);

}  // namespace lamplighter
