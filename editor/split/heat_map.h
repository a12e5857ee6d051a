// The difference of two pictures in false colours, with a legend.
#pragma once

#include <string>

#include "renderer/debug_views/view_picture.h"
#include "renderer/image/image.h"

namespace lamplighter {

// The value of a pixel is the largest |a − b| of its channels, relative to the mean of b. The ramp
// ends at `scale`. Both pictures must have the same size; the result is enlarged to width × height.
// The legend names both pictures.
ViewPicture heatMapOf(const Image& a, const Image& b, float scale, int width, int height,
                      const std::string& nameOfA, const std::string& nameOfB);

// Enlarges a picture of blocks to full size without filtering. Pixels beyond the last block have
// the value of that block.
Image enlarged(const Image& blocks, int width, int height);

}  // namespace lamplighter
