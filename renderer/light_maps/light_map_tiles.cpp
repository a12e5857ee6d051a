#include "renderer/light_maps/light_map_tiles.h"

#include <algorithm>
#include <cmath>

#include "renderer/light_maps/texel_grid.h"
#include "renderer/visibility/patch_demand.h"

namespace lamplighter {
namespace {

constexpr int kMostTexels = TexelGrid::kMostAlong;
constexpr float kFlat = 0.9999f;  // cos 0.8°

// Whether the chart is shaded flat: no smooth normals, normal texture or bumps.
bool isShadedFlat(const RenderScene& s, const Chart& chart) {
  if (chart.isRough) return false;
  const RenderObject& o = s.objects[chart.object];
  if (s.materials[static_cast<size_t>(o.material)].normalTexture.texture != kNone) return false;
  return std::all_of(chart.triangles.begin(), chart.triangles.end(), [&](uint32_t t) {
    for (uint32_t c = 0; c < 3; ++c) {
      const vec3& n = s.normals[s.indices[o.firstIndex + 3 * t + c]];
      const float length = glm::length(n);
      if (length > 0.0f && std::abs(glm::dot(n, chart.normal)) < kFlat * length) return false;
    }
    return true;
  });
}

}  // namespace

void FlatCharts::find(const RenderScene& scene, const ObjectPatches& patches,
                      std::span<const uint8_t> levels) {
  states_.resize(patches.charts.size(), State::unknown);
  for (const int root : patches.roots) {
    const int chart = patches.patches[static_cast<size_t>(root)].chart;
    if (chart == kNone || levels[static_cast<size_t>(root)] == 0) continue;
    State& state = states_[static_cast<size_t>(chart)];
    if (state == State::unknown)
      state = isShadedFlat(scene, patches.charts[static_cast<size_t>(chart)]) ? State::flat
                                                                              : State::other;
  }
}

LightMapTiles findTiles(const ObjectPatches& patches, const FlatCharts& flat,
                        std::span<const uint8_t> levels, float texel) {
  LightMapTiles out;
  out.ofPatch.assign(patches.patches.size(), kNone);
  if (texel <= 0.0f) return out;
  const auto texelsAlong = [&](float length) {
    const float steps = std::ceil(std::min(length / texel, static_cast<float>(kMostTexels)));
    return std::clamp(static_cast<int>(steps) + 1, 2, kMostTexels);
  };
  for (const int root : patches.roots) {
    const uint8_t level = levels[static_cast<size_t>(root)];
    const int chart = patches.patches[static_cast<size_t>(root)].chart;
    if (level == 0 || chart == kNone || !flat[chart]) continue;
    const size_t firstTile = out.tiles.size();
    const uint32_t firstTexel = out.texels;
    // The patches of a chart follow its root.
    for (size_t p = static_cast<size_t>(root);
         p < patches.patches.size() && patches.patches[p].chart == chart; ++p) {
      const Patch& patch = patches.patches[p];
      if (!patch.isLeaf()) continue;
      const vec2 size = patch.max - patch.min;
      const LightMapTile tile{static_cast<int>(p), out.texels, texelsAlong(size.x),
                              texelsAlong(size.y)};
      out.texels += static_cast<uint32_t>(TexelGrid::paddedCount(tile.columns, tile.rows));
      out.tiles.push_back(tile);
    }
    if (out.texels - firstTexel > PatchDemand::leastPixels(level)) {
      out.tiles.resize(firstTile);
      out.texels = firstTexel;
    }
  }
  for (size_t t = 0; t < out.tiles.size(); ++t)
    out.ofPatch[static_cast<size_t>(out.tiles[t].patch)] = static_cast<int>(t);
  return out;
}

}  // namespace lamplighter
