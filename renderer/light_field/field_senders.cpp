#include "renderer/light_field/field_senders.h"

#include <map>
#include <tuple>

namespace lamplighter {
namespace {

constexpr int kBlockSide = 4;  // texels

}  // namespace

SenderBlocks::SenderBlocks(const TexelSet& set) : blockOf(set.size()) {
  for (const TexelSet::Part& part : set.parts()) {
    // By chart and place of the block.
    std::map<std::tuple<uint32_t, int, int>, uint32_t> blocks;
    for (uint32_t t = part.first; t < part.first + part.count; ++t) {
      const SurfaceTexel& texel = set[t];
      const auto [block, isNew] =
          blocks.try_emplace({texel.chart, texel.at.x / kBlockSide, texel.at.y / kBlockSide},
                             static_cast<uint32_t>(texels.size()));
      blockOf[t] = block->second;
      if (isNew) {
        texels.push_back(t);
        continue;
      }
      // The texel nearest to the middle of the block that is not buried.
      const auto far = [&](uint32_t number) {
        const vec2 inBlock(set[number].at.x % kBlockSide, set[number].at.y % kBlockSide);
        return glm::distance(inBlock, vec2(0.5f * (kBlockSide - 1)));
      };
      uint32_t& best = texels[block->second];
      const bool isBetter =
          set.isBuried(t) != set.isBuried(best) ? set.isBuried(best) : far(t) < far(best);
      if (isBetter) best = t;
    }
  }
}

}  // namespace lamplighter
