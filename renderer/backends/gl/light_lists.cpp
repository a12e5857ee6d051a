#include "renderer/backends/gl/light_lists.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "shaders/shared/patches.h"

namespace lamplighter::gl {
namespace {

// A leaf and one of its sides.
struct SeenLeaf {
  uint32_t object;
  int leaf;
  bool mapped;
  size_t place;
};

// Around a leaf's surface, with room for rounding.
Bounds boxOf(const ObjectPatches& patches, const Patch& patch) {
  if (patch.chart == kNone) return patch.box;
  const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
  Bounds box;
  for (const vec2& p :
       {patch.min, vec2(patch.max.x, patch.min.y), patch.max, vec2(patch.min.x, patch.max.y)})
    box.add(chart.at(p));
  const float room = chart.thickness + 0.001f + 0.01f * glm::length(patch.max - patch.min);
  box.min -= room;
  box.max += room;
  return box;
}

std::vector<SeenLeaf> leavesIn(const PatchLights& lights, std::span<const SeenObject> objects,
                               const Frustum& frustum) {
  std::vector<SeenLeaf> out;
  for (const SeenObject& o : objects) {
    const ObjectPatches& patches = lights.patches(o.object);
    for (size_t i = 0; i < patches.patches.size(); ++i) {
      const Patch& patch = patches.patches[i];
      if (!patch.isLeaf() || !frustum.mayMeet(boxOf(patches, patch))) continue;
      const int leaf = static_cast<int>(i);
      const bool mapped = lights.isMapped(o.object, leaf);
      const size_t place = 1 + 2 * (o.firstNode + i);
      if (mapped) out.push_back({o.object, leaf, true, place + 1});
      if (!mapped || !o.backIsCulled) out.push_back({o.object, leaf, false, place});
    }
  }
  return out;
}

}  // namespace

void LightLists::make(const PatchLights& patches, std::span<const SeenObject> objects, size_t nodes,
                      const Frustum& frustum, std::span<const shared::Vpl> vpls,
                      std::span<const LightGroup> groups) {
  const size_t stride = places(nodes);
  ranges_.assign(stride * groups.size(), glm::uvec2(0));
  entries_.clear();
  longest_.assign(groups.size(), 0);
  if (vpls.empty()) return;
  const std::vector<SeenLeaf> leaves = leavesIn(patches, objects, frustum);

  // Blocks of leaves write lists of their own, which then follow each other.
  constexpr size_t kBlock = 64;
  struct Block {
    std::vector<uint32_t> entries;
    std::vector<int> longest;
    size_t first = 0;
  };
  std::vector<Block> blocks((leaves.size() + kBlock - 1) / kBlock);
  const auto forEachLeaf = [&](auto&& visit) {
    tbb::parallel_for(size_t{0}, blocks.size(), [&](size_t b) {
      const size_t last = std::min((b + 1) * kBlock, leaves.size());
      visit(blocks[b], std::span(leaves).subspan(b * kBlock, last - b * kBlock));
    });
  };
  forEachLeaf([&](Block& block, std::span<const SeenLeaf> mine) {
    std::vector<LightUse> uses(patches.slots());
    block.longest.assign(groups.size(), 0);
    for (const SeenLeaf& leaf : mine) {
      patches.uses(leaf.object, leaf.leaf, leaf.mapped, uses);
      const auto useOf = [&](const shared::Vpl& vpl) {
        const int slot = static_cast<int>(vpl.intensity.w);
        return slot < 0 ? LightUse::add : uses[static_cast<size_t>(slot)];
      };
      for (size_t g = 0; g < groups.size(); ++g) {
        const auto lights = vpls.subspan(groups[g].first, groups[g].count);
        const size_t first = block.entries.size();
        for (uint32_t i = 0; i < lights.size(); ++i)
          if (useOf(lights[i]) == LightUse::add) block.entries.push_back(i);
        const size_t shadowed = block.entries.size();
        for (uint32_t i = 0; i < lights.size(); ++i) {
          const LightUse use = useOf(lights[i]);
          if (use == LightUse::addShadowed) block.entries.push_back(i);
          if (use == LightUse::takeShadow) block.entries.push_back(i + shared::kTakeShadow);
        }
        const size_t end = block.entries.size();
        ranges_[g * stride + leaf.place] = {first, (shadowed - first) | (end - shadowed) << 16};
        block.longest[g] = std::max(block.longest[g], static_cast<int>(end - first));
      }
    }
  });
  size_t size = 0;
  for (Block& block : blocks) {
    block.first = size;
    size += block.entries.size();
    for (size_t g = 0; g < groups.size(); ++g)
      longest_[g] = std::max(longest_[g], block.longest[g]);
  }
  entries_.resize(size);
  forEachLeaf([&](const Block& block, std::span<const SeenLeaf> mine) {
    std::copy(block.entries.begin(), block.entries.end(),
              entries_.begin() + static_cast<ptrdiff_t>(block.first));
    for (const SeenLeaf& leaf : mine)
      for (size_t g = 0; g < groups.size(); ++g)
        ranges_[g * stride + leaf.place].x += static_cast<uint32_t>(block.first);
  });
}

}  // namespace lamplighter::gl
