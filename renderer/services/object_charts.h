// Charts and texel layouts of the objects of a scene, computed once for all instances of a mesh.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "renderer/atlas/mesh_atlas.h"
#include "renderer/base/content_cache.h"
#include "renderer/scene/own_space.h"

namespace lamplighter {

// The layout of one object's mesh, and the object's place in the world.
struct ObjectAtlas {
  std::shared_ptr<const MeshAtlas> atlas;  // in object space; null: the object has none
  OwnSpace space;

  vec3 toOwn(const vec3& world) const {
    return glm::transpose(space.rotation) * (world - space.translation) / space.scale;
  }
  // Projects a world-space point of a triangle to the rectangle of the atlas [texels].
  vec2 texelsOf(uint32_t triangle, const vec3& world) const {
    return atlas->texelsOf(triangle, toOwn(world));
  }
};

// Layouts are keyed by content: the vertices and indices of the mesh, its stretch and the density.
// They are kept in memory while an object uses them, and on disk.
class ObjectCharts {
 public:
  // Size limit of all files together; the oldest files are deleted first.
  static constexpr uintmax_t kMostBytes = uintmax_t{256} << 20;

  // An empty path: nothing is kept on disk.
  explicit ObjectCharts(std::filesystem::path folder) : files_(std::move(folder), {"atl", 1}) {}

  // Call with all changes of the scene between calls of find().
  void outdate(const RenderSceneChanges& changes) { changes_.merge(changes); }
  // By object. Missing layouts are loaded or computed, in parallel. Area lights, empty objects, and
  // objects that are scaled by 0 along an axis have none. Valid until the next call.
  std::span<const ObjectAtlas> find(const RenderScene& scene, float texelsPerMetre);

  size_t computed() const { return computed_; }  // layouts since construction
  std::filesystem::path fileOf(uint32_t object) const { return files_.fileOf(*keys_[object]); }

 private:
  void place(const RenderScene& scene, uint32_t object);

  ContentCache files_;
  RenderSceneChanges changes_;
  float texelsPerMetre_ = 0.0f;  // of the last find(); 0: there was none
  std::vector<ObjectAtlas> objects_;
  std::vector<std::optional<ContentKey>> keys_;  // by object
  std::map<ContentKey, std::shared_ptr<const MeshAtlas>> known_;
  size_t computed_ = 0;
};

}  // namespace lamplighter
