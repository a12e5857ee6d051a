#include "renderer/patches/mesh_topologies.h"

#include <optional>

#include <tbb/parallel_for.h>

#include "renderer/patches/topology_file.h"

namespace lamplighter {

ContentKey MeshTopologies::keyOf(const RenderScene& scene, uint32_t object,
                                 const TopologyLimits& limits) {
  const RenderObject& o = scene.objects[object];
  const ShapeKey shape = shapeOf(o);
  ContentHash hash;
  for (const float limit : {limits.large, limits.rough, limits.largeRough, limits.smallestCluster})
    hash.add(limit);
  hash.add(shape.scale);
  hash.add(uint64_t{shape.mirrored});
  hash.add(static_cast<uint64_t>(shape.kind));
  hash.add(uint64_t{o.vertexCount});
  forEachWord(std::span(scene.localPositions).subspan(o.firstVertex, o.vertexCount),
              [&](uint64_t word) { hash.add(word); });
  hash.add(uint64_t{o.indexCount});
  const auto corner = [&](uint32_t i) {
    return uint64_t{scene.indices[o.firstIndex + i] - o.firstVertex};
  };
  for (uint32_t i = 0; i + 1 < o.indexCount; i += 2) hash.add(corner(i) << 32 | corner(i + 1));
  if (o.indexCount % 2 != 0) hash.add(corner(o.indexCount - 1));
  return hash.key();
}

std::vector<std::shared_ptr<const MeshTopology>> MeshTopologies::find(
    const RenderScene& scene, std::span<const uint32_t> objects, bool isPassing,
    const TopologyLimits& limits) {
  std::vector<ContentKey> keys(objects.size());
  tbb::parallel_for(size_t{0}, keys.size(),
                    [&](size_t i) { keys[i] = keyOf(scene, objects[i], limits); });
  struct Missing {
    uint32_t object;
    ContentKey key;
    std::shared_ptr<const MeshTopology> topology;
    bool isComputed = false, isSaved = false;
  };
  std::vector<Missing> missing;
  std::map<ContentKey, std::shared_ptr<const MeshTopology>> used;
  for (size_t i = 0; i < keys.size(); ++i) {
    const auto [entry, isNew] = used.try_emplace(keys[i]);
    if (!isNew) continue;
    if (const auto known = known_.find(keys[i]); known != known_.end())
      entry->second = known->second.lock();
    if (!entry->second) missing.push_back({objects[i], keys[i], nullptr});
  }
  tbb::parallel_for(size_t{0}, missing.size(), [&](size_t i) {
    Missing& m = missing[i];
    const bool hasFile = !isPassing && scene.objects[m.object].triangleCount() >= kLeastTriangles;
    std::optional<MeshTopology> topology;
    if (hasFile)
      if (const auto bytes = files_.load(m.key)) topology = topologyOf(*bytes, scene, m.object);
    m.isComputed = !topology;
    if (!topology) topology = findTopology(scene, m.object, limits);
    m.isSaved = hasFile && m.isComputed && files_.save(m.key, bytesOf(*topology));
    m.topology = std::make_shared<const MeshTopology>(std::move(*topology));
  });
  std::erase_if(known_, [](const auto& entry) { return entry.second.expired(); });
  bool isSaved = false;
  for (Missing& m : missing) {
    known_[m.key] = m.topology;
    used[m.key] = std::move(m.topology);
    computed_ += m.isComputed;
    isSaved = isSaved || m.isSaved;
  }
  if (isSaved) files_.keepWithin(kMostBytes);
  std::vector<std::shared_ptr<const MeshTopology>> found;
  found.reserve(keys.size());
  for (const ContentKey& key : keys) found.push_back(used.at(key));
  return found;
}

}  // namespace lamplighter
