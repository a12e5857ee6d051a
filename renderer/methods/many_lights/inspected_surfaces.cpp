#include "renderer/methods/many_lights/inspected_surfaces.h"

namespace lamplighter {

int DatabasePatches::leafAt(uint32_t object, uint32_t triangle, const vec3& position) const {
  return visibility_.patches(object).leafAt(triangle, position);
}

int DatabasePatches::patchOf(uint32_t object, int leaf) const {
  return visibility_.wholeOf(object, leaf);
}

PatchView::Shape DatabasePatches::shapeOf(uint32_t object, int patch) const {
  const std::vector<Patch>& patches = visibility_.patches(object).patches;
  const Patch& p = patches[static_cast<size_t>(patch)];
  Shape shape;
  for (int parent = p.parent; parent != kNone; parent = patches[static_cast<size_t>(parent)].parent)
    ++shape.level;
  shape.isPlanar = p.chart != kNone;
  shape.size = shape.isPlanar ? p.max - p.min : vec2(2.0f * p.box.radius());
  return shape;
}

std::span<const uint8_t> DatabasePatches::states(uint32_t object, int leaf) const {
  return visibility_.row(object, leaf);
}

void DatabasePatches::forEachPatch(const Visit& visit) const {
  std::vector<int> open;
  for (uint32_t object = 0; object < visibility_.objects(); ++object) {
    const ObjectPatches& patches = visibility_.patches(object);
    open.assign(patches.roots.begin(), patches.roots.end());
    while (!open.empty()) {
      const int patch = open.back();
      open.pop_back();
      const Patch& p = patches.patches[static_cast<size_t>(patch)];
      if (!p.isLeaf() && visibility_.isDivided(object, patch))
        open.insert(open.end(), {p.firstChild, p.firstChild + 1});
      else
        visit(visibility_.row(object, patch));
    }
  }
}

std::optional<TexelView::Grid> LightMapTexels::gridAt(uint32_t object, uint32_t triangle,
                                                      const vec3& position) const {
  const ObjectPatches& patches = visibility_.patches(object);
  const int leaf = patches.leafAt(triangle, position);
  const LightMapTile* tile = maps_.tile(object, leaf);
  if (tile == nullptr) return std::nullopt;
  const Patch& patch = patches.patches[static_cast<size_t>(leaf)];
  const Chart& chart = patches.charts[static_cast<size_t>(patch.chart)];
  Grid grid;
  grid.cells = vec2(static_cast<float>(tile->columns - 1), static_cast<float>(tile->rows - 1));
  grid.size = patch.max - patch.min;
  grid.at = (chart.project(position) - patch.min) * (grid.cells / grid.size);
  return grid;
}

vec3 LightMapTexels::irradianceAt(uint32_t object, uint32_t triangle, const vec3& position) const {
  const ObjectPatches& patches = visibility_.patches(object);
  return maps_.irradiance(patches, object, patches.leafAt(triangle, position), position);
}

}  // namespace lamplighter
