// Sums of pictures.
#pragma once

#include <tbb/parallel_for.h>

#include "renderer/image/image.h"

namespace lamplighter {

// Adds a picture, multiplied by a factor, to a sum of the same size.
inline void addScaled(Image& sum, const Image& image, float scale) {
  tbb::parallel_for(0, sum.height, [&](int y) {
    for (int x = 0; x < sum.width; ++x) sum.at(x, y) += scale * image.at(x, y);
  });
}

}  // namespace lamplighter
