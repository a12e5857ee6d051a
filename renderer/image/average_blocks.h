// Pictures reduced by whole blocks of pixels.
#pragma once

#include <algorithm>

#include "renderer/image/image.h"

namespace lamplighter {

// Blocks along a side; at least one.
inline int blocksOf(int pixels, int block) { return std::max(1, pixels / std::max(block, 1)); }

// The picture averaged over blocks of pixels. Incomplete blocks at the right and bottom are left
// out. A picture smaller than a block becomes one block.
Image averageBlocks(const Image& picture, int block);

}  // namespace lamplighter
