// Texels at which light for further bounces is computed: one per block of 4 × 4 texels of a chart.
// Light that bounces again is gathered from a large area, so that it needs no finer texels; blocks
// cost a sixteenth.
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
