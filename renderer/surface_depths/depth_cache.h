// Cache of depths on disk: a level that was opened before needs no rays for its depths.
#pragma once

#include <filesystem>
#include <optional>

#include "renderer/base/content_cache.h"
#include "renderer/surface_depths/surface_depths.h"

namespace lamplighter {

class DepthCache {
 public:
  // Size limit of all files together; the oldest files are deleted first.
  static constexpr uintmax_t kMostBytes = uintmax_t{256} << 20;

  // An empty path: nothing is kept on disk.
  explicit DepthCache(std::filesystem::path folder) : files_(std::move(folder), {"depths", 1}) {}

  // A hash of everything that depths depend on: places of texels, triangles, sides of materials,
  // the layout. None with alpha masks, whose textures would have to be hashed.
  static std::optional<ContentKey> keyOf(const RenderScene& scene, const TexelSet& texels,
                                         const DepthMapLayout& layout);
  // Fills depths after SurfaceDepths::restart(). Returns false if there is no valid file.
  bool load(const ContentKey& key, SurfaceDepths& depths) const;
  void save(const ContentKey& key, const SurfaceDepths& depths) const;
  std::filesystem::path fileOf(const ContentKey& key) const { return files_.fileOf(key); }

 private:
  ContentCache files_;
};

}  // namespace lamplighter
