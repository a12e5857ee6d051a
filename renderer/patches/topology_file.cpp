#include "renderer/patches/topology_file.h"

#include <algorithm>

#include "renderer/base/byte_stream.h"
#include "renderer/patches/triangle_order.h"

namespace lamplighter {
namespace {

struct StoredSizes {
  uint32_t charts, loose, clusters;
};
// Followed by its triangles and its outline.
struct StoredChart {
  uint32_t seed, isRough, longestEdge[2], triangles, outline;
};

template <typename T>
bool takeAll(std::span<const uint8_t>& bytes, std::vector<T>& values, size_t count) {
  if (count > bytes.size() / sizeof(T)) return false;
  values.resize(count);
  return take(bytes, values.data(), count);
}

bool areBelow(std::span<const uint32_t> values, uint32_t limit) {
  return std::all_of(values.begin(), values.end(), [&](uint32_t v) { return v < limit; });
}

// Whether each triangle is in exactly one chart or loose.
bool isPartition(const MeshTopology& topology, uint32_t triangles) {
  std::vector<bool> seen(triangles, false);
  size_t count = 0;
  const auto add = [&](std::span<const uint32_t> part) {
    count += part.size();
    for (const uint32_t t : part) {
      if (t >= triangles || seen[t]) return false;
      seen[t] = true;
    }
    return true;
  };
  for (const ChartTopology& chart : topology.charts)
    if (chart.triangles.empty() || !add(chart.triangles)) return false;
  return add(topology.loose) && count == triangles;
}

// Whether the clusters are a tree in which each node divides its range, at whole groups, between
// two children that follow it.
bool areTree(const std::vector<ClusterTopology>& clusters, size_t loose) {
  if (loose == 0) return clusters.empty();
  if (clusters.empty() || clusters[0].first != 0 || clusters[0].count != loose) return false;
  std::vector<bool> isReached(clusters.size(), false);
  isReached[0] = true;
  for (size_t i = 0; i < clusters.size(); ++i) {
    const ClusterTopology& c = clusters[i];
    if (!isReached[i]) return false;
    if (c.firstChild == kNone) continue;
    const auto child = static_cast<size_t>(c.firstChild);
    if (c.firstChild < 0 || child <= i || child + 1 >= clusters.size() || isReached[child] ||
        isReached[child + 1])
      return false;
    const ClusterTopology &left = clusters[child], &right = clusters[child + 1];
    if (left.first != c.first || left.count == 0 || left.count >= c.count ||
        left.count % kGroupTriangles != 0 || right.first != c.first + left.count ||
        right.count != c.count - left.count)
      return false;
    isReached[child] = isReached[child + 1] = true;
  }
  return true;
}

}  // namespace

std::vector<uint8_t> bytesOf(const MeshTopology& topology) {
  std::vector<uint8_t> bytes;
  const auto sizeOf = [](const auto& values) { return static_cast<uint32_t>(values.size()); };
  const StoredSizes sizes{sizeOf(topology.charts), sizeOf(topology.loose),
                          sizeOf(topology.clusters)};
  append(bytes, &sizes, 1);
  for (const ChartTopology& c : topology.charts) {
    const StoredChart stored{c.seed,
                             c.isRough ? 1u : 0u,
                             {c.longestEdge[0], c.longestEdge[1]},
                             sizeOf(c.triangles),
                             sizeOf(c.outline)};
    append(bytes, &stored, 1);
    append(bytes, c.triangles.data(), c.triangles.size());
    append(bytes, c.outline.data(), c.outline.size());
  }
  append(bytes, topology.loose.data(), topology.loose.size());
  append(bytes, topology.clusters.data(), topology.clusters.size());
  return bytes;
}

std::optional<MeshTopology> topologyOf(std::span<const uint8_t> bytes, const RenderScene& scene,
                                       uint32_t object) {
  const RenderObject& o = scene.objects[object];
  MeshTopology out;
  out.shape = shapeOf(o);
  StoredSizes sizes;
  if (!take(bytes, &sizes, 1) || sizes.charts > bytes.size() / sizeof(StoredChart))
    return std::nullopt;
  out.charts.resize(sizes.charts);
  for (ChartTopology& c : out.charts) {
    StoredChart stored;
    if (!take(bytes, &stored, 1) || !takeAll(bytes, c.triangles, stored.triangles) ||
        !takeAll(bytes, c.outline, stored.outline))
      return std::nullopt;
    c.seed = stored.seed;
    c.isRough = stored.isRough != 0;
    c.longestEdge = {stored.longestEdge[0], stored.longestEdge[1]};
    if (c.seed >= o.triangleCount() || !areBelow(c.longestEdge, o.vertexCount) ||
        !areBelow(c.outline, o.vertexCount))
      return std::nullopt;
  }
  if (!takeAll(bytes, out.loose, sizes.loose) || !takeAll(bytes, out.clusters, sizes.clusters) ||
      !bytes.empty() || !isPartition(out, o.triangleCount()) ||
      !areTree(out.clusters, out.loose.size()))
    return std::nullopt;
  addOccluders(MeshShape(scene, o, out.shape.scale), out);
  return out;
}

}  // namespace lamplighter
