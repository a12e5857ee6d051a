// The topologies of the meshes of a scene, found once for all instances of a mesh.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "renderer/base/content_cache.h"
#include "renderer/patches/topology.h"

namespace lamplighter {

// Topologies are keyed by content: the vertices and triangles of a mesh, its shape and the limits.
// They are kept in memory while someone holds them, and those of large meshes on disk.
class MeshTopologies {
 public:
  // Meshes with fewer triangles are computed as fast as their files are read.
  static constexpr uint32_t kLeastTriangles = 1024;
  // Size limit of all files together; the oldest files are deleted first.
  static constexpr uintmax_t kMostBytes = uintmax_t{256} << 20;

  // An empty path: nothing is kept on disk.
  explicit MeshTopologies(std::filesystem::path folder = {})
      : files_(std::move(folder), {"top", 1}) {}

  // In the order of `objects`. Missing topologies are loaded or computed, in parallel.
  // isPassing: others will soon replace them, as in a drag; no file is read or written.
  std::vector<std::shared_ptr<const MeshTopology>> find(const RenderScene& scene,
                                                        std::span<const uint32_t> objects,
                                                        bool isPassing = false,
                                                        const TopologyLimits& limits = {});

  size_t computed() const { return computed_; }  // topologies since construction
  static ContentKey keyOf(const RenderScene& scene, uint32_t object,
                          const TopologyLimits& limits = {});
  std::filesystem::path fileOf(const ContentKey& key) const { return files_.fileOf(key); }

 private:
  ContentCache files_;
  std::map<ContentKey, std::weak_ptr<const MeshTopology>> known_;
  size_t computed_ = 0;
};

}  // namespace lamplighter
