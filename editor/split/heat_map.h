// How far two pictures are apart, in false colour with a legend.
#pragma once

#include <string>

#include "renderer/debug_views/view_picture.h"
#include "renderer/image/image.h"

namespace lamplighter {

// The largest |a − b| of a pixel's channels as a share of the mean of b: the ramp ends at `scale`.
// Both of one size; the picture is enlarged to width × height. The legend names what they are.
ViewPicture heatMapOf(const Image& a, const Image& b, float scale, int width, int height,
                      const std::string& nameOfA, const std::string& nameOfB);

// A picture of blocks at the size of what they are blocks of, each as it is; pixels beyond the last
// block are that block's.
Image enlarged(const Image& blocks, int width, int height);

}  // namespace lamplighter
