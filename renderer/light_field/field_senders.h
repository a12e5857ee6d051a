// Texels that find light which goes on to bounce: one of each block of a chart. Light that bounces
// again is gathered from far around, so that it needs no finer texels; 4 × 4 of them cost a
// sixteenth.
#pragma once

#include <vector>

#include "renderer/texels/texel_set.h"

namespace lamplighter {

struct SenderBlocks {
  std::vector<uint32_t> texels;   // one of each block
  std::vector<uint32_t> blockOf;  // by texel

  SenderBlocks() = default;
  explicit SenderBlocks(const TexelSet& texels);
};

}  // namespace lamplighter
