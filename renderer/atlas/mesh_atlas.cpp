#include "renderer/atlas/mesh_atlas.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "renderer/base/byte_stream.h"
#include "renderer/scene/scene.h"

namespace lamplighter {
namespace {

// Sets chartOfTriangle. Returns false if a triangle is in several charts or does not exist.
bool indexTriangles(MeshAtlas& atlas, size_t triangles) {
  atlas.chartOfTriangle.assign(triangles, kNone);
  for (size_t i = 0; i < atlas.charts.size(); ++i) {
    for (const uint32_t t : atlas.charts[i].chart.triangles) {
      if (t >= triangles || atlas.chartOfTriangle[t] != kNone) return false;
      atlas.chartOfTriangle[t] = static_cast<int>(i);
    }
  }
  return true;
}

// What a file holds of a chart, followed by its triangles.
struct StoredChart {
  vec3 tangent, bitangent, normal;
  vec2 min, max;
  glm::ivec2 at, size;
  float texelsPerMetre;
  uint32_t triangles;
};
static_assert(std::is_trivially_copyable_v<StoredChart>);

}  // namespace

MeshAtlas makeMeshAtlas(std::span<const vec3> positions, std::span<const uint32_t> indices,
                        float texelsPerMetre) {
  MeshAtlas atlas;
  int64_t area = 0;
  int widest = 1;
  for (MeshChart& chart : unwrap(positions, indices, texelsPerMetre)) {
    PlacedChart& placed = atlas.charts.emplace_back();
    placed.chart = std::move(chart);
    setDensity(placed, texelsPerMetre);
    area += int64_t{placed.size.x} * placed.size.y;
    widest = std::max({widest, placed.size.x, placed.size.y});
  }
  indexTriangles(atlas, indices.size() / 3);
  std::vector<PlacedChart*> charts;
  for (PlacedChart& chart : atlas.charts) charts.push_back(&chart);
  // The smallest square on which the heuristic succeeds, in steps of an eighth.
  int side = std::max(widest, static_cast<int>(std::ceil(std::sqrt(static_cast<double>(area)))));
  for (bool isPlaced = charts.empty(); !isPlaced; side += std::max(side / 8, 1)) {
    Skyline page(side);
    isPlaced = placeOn(page, charts);
  }
  for (const PlacedChart& chart : atlas.charts)
    atlas.size = glm::max(atlas.size, chart.at + chart.size);
  return atlas;
}

std::vector<uint8_t> bytesOf(const MeshAtlas& atlas) {
  std::vector<uint8_t> bytes;
  append(bytes, &atlas.size, 1);
  const uint64_t count = atlas.charts.size();
  append(bytes, &count, 1);
  for (const PlacedChart& placed : atlas.charts) {
    const MeshChart& c = placed.chart;
    const StoredChart stored{c.tangent,
                             c.bitangent,
                             c.normal,
                             c.min,
                             c.max,
                             placed.at,
                             placed.size,
                             placed.texelsPerMetre,
                             static_cast<uint32_t>(c.triangles.size())};
    append(bytes, &stored, 1);
    append(bytes, c.triangles.data(), c.triangles.size());
  }
  return bytes;
}

std::optional<MeshAtlas> meshAtlasOf(std::span<const uint8_t> bytes, size_t triangles) {
  MeshAtlas atlas;
  uint64_t count = 0;
  if (!take(bytes, &atlas.size, 1) || !take(bytes, &count, 1) ||
      count > bytes.size() / sizeof(StoredChart))
    return std::nullopt;
  atlas.charts.resize(count);
  for (PlacedChart& placed : atlas.charts) {
    StoredChart stored;
    if (!take(bytes, &stored, 1) || stored.triangles > triangles) return std::nullopt;
    MeshChart& c = placed.chart;
    c.tangent = stored.tangent;
    c.bitangent = stored.bitangent;
    c.normal = stored.normal;
    c.min = stored.min;
    c.max = stored.max;
    placed.at = stored.at;
    placed.size = stored.size;
    placed.texelsPerMetre = stored.texelsPerMetre;
    c.triangles.resize(stored.triangles);
    if (!take(bytes, c.triangles.data(), c.triangles.size()) ||
        glm::any(glm::lessThan(placed.at, glm::ivec2(0))) ||
        glm::any(glm::greaterThan(placed.at + placed.size, atlas.size)))
      return std::nullopt;
  }
  if (!bytes.empty() || !indexTriangles(atlas, triangles)) return std::nullopt;
  return atlas;
}

}  // namespace lamplighter
