#include "renderer/visibility/light_clusters.h"

#include <algorithm>
#include <cstdint>

#include "renderer/base/math.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {
namespace {

constexpr size_t kMostLights = 16;
constexpr float kMostExtent = 2.0f;  // [m]

uint64_t spread(uint64_t v) {  // spreads 10 bits to every third bit
  v = (v | v << 16) & 0x030000ff;
  v = (v | v << 8) & 0x0300f00f;
  v = (v | v << 4) & 0x030c30c3;
  return (v | v << 2) & 0x09249249;
}

}  // namespace

LightClusters clusterLights(std::span<const shared::Vpl> bySlot) {
  LightClusters out;
  out.clusterOf.assign(bySlot.size(), -1);
  const auto isClustered = [](const shared::Vpl& v) {
    return vec3(v.normal) != vec3(0.0f) && v.position.w != shared::kVplDirectional;
  };
  Bounds all;
  for (const shared::Vpl& v : bySlot)
    if (isClustered(v)) all.add(vec3(v.position));
  const vec3 scale = 1023.0f / glm::max(all.empty() ? vec3(1.0f) : all.extent(), vec3(1e-6f));
  std::vector<std::pair<uint64_t, int>> keys;  // Morton codes per side of a cube of normals
  for (size_t slot = 0; slot < bySlot.size(); ++slot) {
    const shared::Vpl& v = bySlot[slot];
    if (!isClustered(v)) {
      out.order.push_back(static_cast<int>(slot));
      continue;
    }
    const vec3 p = (vec3(v.position) - all.min) * scale;
    const uint64_t key = spread(static_cast<uint64_t>(p.x)) |
                         spread(static_cast<uint64_t>(p.y)) << 1 |
                         spread(static_cast<uint64_t>(p.z)) << 2;
    keys.emplace_back(sideOf(vec3(v.normal)) << 32 | key, static_cast<int>(slot));
  }
  std::sort(keys.begin(), keys.end());
  int cluster = -1;
  size_t count = 0;
  Bounds box;
  uint64_t side = 0;
  for (const auto& [key, slot] : keys) {
    const vec3 p(bySlot[static_cast<size_t>(slot)].position);
    Bounds with = box;
    with.add(p);
    const vec3 extent = with.extent();
    if (cluster < 0 || count == kMostLights || side != key >> 32 ||
        std::max({extent.x, extent.y, extent.z}) > kMostExtent) {
      ++cluster;
      count = 0;
      side = key >> 32;
      with = Bounds();
      with.add(p);
    }
    box = with;
    ++count;
    out.order.push_back(slot);
    out.clusterOf[static_cast<size_t>(slot)] = cluster;
  }
  return out;
}

}  // namespace lamplighter
