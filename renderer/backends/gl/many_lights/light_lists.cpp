#include "renderer/backends/gl/many_lights/light_lists.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "renderer/visibility/hard_shadow_lights.h"
#include "shaders/shared/patches.h"

namespace lamplighter::gl {
namespace {

// Patches that one task processes, and the lists of their leaves.
struct Block {
  SeenObject object;
  size_t first, last;  // of the object's patches
  std::vector<size_t> places;
  std::vector<uint32_t> entries;
  std::vector<int> longest, longestPlain;
  size_t start = 0;  // index of its first entry among all
};

// The bounds of a patch, enlarged for rounding.
Bounds boxOf(const Patch& patch) {
  const vec3 half(1.01f * patch.radius + 0.001f);
  return {patch.centre - half, patch.centre + half};
}

std::vector<int> hardSlots(std::span<const shared::Vpl> vpls, size_t slots) {
  std::vector<LightStrength> strengths;
  for (const shared::Vpl& vpl : vpls) {
    const bool hasUse = vpl.slot >= 0 && static_cast<size_t>(vpl.slot) < slots;
    strengths.push_back(strengthOf(vpl, hasUse ? vpl.slot : -1));
  }
  return hardLights(strengths);
}

}  // namespace

void LightLists::make(const PatchLights& patches, std::span<const SeenObject> objects, size_t nodes,
                      const Frustum& frustum, std::span<const shared::Vpl> vpls,
                      std::span<const LightGroup> groups) {
  const size_t stride = stride_ = places(nodes);
  ranges_.assign(stride * groups.size(), glm::uvec2(0));
  entries_.clear();
  longest_.assign(groups.size(), 0);
  longestPlain_.assign(groups.size(), 0);
  groups_.assign(groups.begin(), groups.end());
  objects_.clear();
  passes_.assign(groups.size(), 0);
  passesSaved_ = 0;
  const std::vector<int> hard = hardSlots(vpls, patches.slots());
  hardPlaces_.assign(hard.empty() ? 0 : stride, 0u);
  if (vpls.empty()) return;
  constexpr size_t kPatches = 256;
  std::vector<Block> blocks;
  for (const SeenObject& o : objects) {
    const size_t count = patches.patches(o.object).patches.size();
    for (size_t first = 0; first < count; first += kPatches)
      blocks.push_back({o, first, std::min(first + kPatches, count), {}, {}, {}, {}});
  }

  tbb::parallel_for(size_t{0}, blocks.size(), [&](size_t b) {
    Block& block = blocks[b];
    const SeenObject& object = block.object;
    const ObjectPatches& tree = patches.patches(object.object);
    std::vector<ShadowMode> uses(patches.slots());
    block.longest.assign(groups.size(), 0);
    block.longestPlain.assign(groups.size(), 0);
    const auto useOf = [&](const shared::Vpl& vpl) {
      return vpl.slot < 0 ? ShadowMode::add : uses[static_cast<size_t>(vpl.slot)];
    };
    const auto addPlace = [&](int leaf, bool mapped) {
      const size_t place =
          1 + 2 * (object.firstNode + static_cast<size_t>(leaf)) + (mapped ? 1 : 0);
      block.places.push_back(place);
      patches.uses(object.object, leaf, mapped, uses);
      for (const int slot : hard) {
        const ShadowMode use = uses[static_cast<size_t>(slot)];
        if (readsShadowMap(use)) hardPlaces_[place] = 1;
      }
      for (size_t g = 0; g < groups.size(); ++g) {
        const auto lights = vpls.subspan(groups[g].first, groups[g].count);
        const size_t first = block.entries.size();
        for (uint32_t i = 0; i < lights.size(); ++i)
          if (useOf(lights[i]) == ShadowMode::add) block.entries.push_back(i);
        const size_t shadowed = block.entries.size();
        for (uint32_t i = 0; i < lights.size(); ++i) {
          const ShadowMode use = useOf(lights[i]);
          if (use == ShadowMode::addShadowed) block.entries.push_back(i);
          if (use == ShadowMode::subtractShadow) block.entries.push_back(i + shared::kTakeShadow);
        }
        const size_t end = block.entries.size();
        ranges_[g * stride + place] = {first, (shadowed - first) | (end - shadowed) << 16};
        block.longest[g] = std::max(block.longest[g], static_cast<int>(end - first));
        block.longestPlain[g] = std::max(block.longestPlain[g], static_cast<int>(shadowed - first));
      }
    };
    for (size_t i = block.first; i < block.last; ++i) {
      const Patch& patch = tree.patches[i];
      if (!patch.isLeaf() || !frustum.mayMeet(boxOf(patch))) continue;
      const int leaf = static_cast<int>(i);
      const bool mapped =
          patches.isMapped(object.object, leaf) || patches.hasTransfer(object.object, leaf);
      if (mapped) addPlace(leaf, true);
      if (!mapped || !object.backIsCulled) addPlace(leaf, false);
    }
  });

  size_t size = 0;
  for (Block& block : blocks) {
    block.start = size;
    size += block.entries.size();
    for (size_t g = 0; g < groups.size(); ++g) {
      longest_[g] = std::max(longest_[g], block.longest[g]);
      longestPlain_[g] = std::max(longestPlain_[g], block.longestPlain[g]);
    }
    if (objects_.empty() || objects_.back().object != block.object.object)
      objects_.push_back({block.object.object, {}});
    auto& all = objects_.back().places;
    all.insert(all.end(), block.places.begin(), block.places.end());
  }
  entries_.resize(size);
  tbb::parallel_for(size_t{0}, blocks.size(), [&](size_t b) {
    const Block& block = blocks[b];
    std::copy(block.entries.begin(), block.entries.end(),
              entries_.begin() + static_cast<ptrdiff_t>(block.start));
    for (const size_t place : block.places)
      for (size_t g = 0; g < groups.size(); ++g)
        ranges_[g * stride + place].x += static_cast<uint32_t>(block.start);
  });
}

}  // namespace lamplighter::gl
