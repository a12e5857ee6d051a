// Which leaf patches of an object have light maps, and where their texels are stored.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/patches/patch_set.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct LightMapTile {
  int patch = kNone;          // the leaf; index into the patches of the object
  uint32_t first = 0;         // index of its first texel in the arrays of the object; row by row
  int columns = 0, rows = 0;  // along tangent and bitangent of the chart; at least 2
};

struct LightMapTiles {
  std::vector<int> ofPatch;  // kNone: no tile
  std::vector<LightMapTile> tiles;
  uint32_t texels = 0;  // padded, see TexelGrid
};

// The charts of one object that have light maps: those that are shaded flat. Each chart is tested
// when it is first needed.
class FlatCharts {
 public:
  void find(const RenderScene& scene, const ObjectPatches& patches,
            std::span<const uint8_t> levels);
  bool operator[](int chart) const { return states_[static_cast<size_t>(chart)] == State::flat; }

 private:
  enum class State : uint8_t { unknown, flat, other };
  std::vector<State> states_;
};

// The tiles at a texel spacing [m]. `levels`: by patch, as VisibilityDatabase::levels(): only roots
// with entries have tiles, and only those with no more texels than pixels, since other pixels are
// summed faster without.
LightMapTiles findTiles(const ObjectPatches& patches, const FlatCharts& flat,
                        std::span<const uint8_t> levels, float texel);

}  // namespace lamplighter
