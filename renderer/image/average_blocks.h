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
// The same with a mask: each block is averaged over its pixels with .r > 0.5 in `mask` (of the same
// size, or null: over all pixels); 0 if there are none.
Image averageBlocks(const Image& picture, int block, const Image* mask);
// The mask of such blocks: 1 where at least half of the pixels count.
Image blockMask(const Image& mask, int block);

}  // namespace lamplighter
