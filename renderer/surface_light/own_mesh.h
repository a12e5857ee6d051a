// The triangles of an object without its rotation and translation, and samples known by their
// place.
#pragma once

#include <bit>
#include <cstdint>
#include <unordered_map>
#include <utility>

#include "renderer/base/random.h"
#include "renderer/patches/topology.h"
#include "renderer/scene/render_scene.h"

namespace lamplighter {

class OwnMesh {
 public:
  OwnMesh(const RenderScene& scene, uint32_t object);

  struct Vertex {
    vec3 position, normal;  // the normal is a unit vector on the given side
  };
  // Of a corner of a triangle. Normals on the wrong side are replaced by that of the triangle.
  Vertex vertex(uint32_t triangle, uint32_t corner, bool isBack) const;
  uint32_t corner(uint32_t triangle, uint32_t corner) const {
    return scene_.indices[object_.firstIndex + 3 * triangle + corner] - object_.firstVertex;
  }
  float area(uint32_t triangle) const { return 0.5f * glm::length(cross(triangle)); }  // [m²]
  // On the front side; zero if the triangle has no area.
  vec3 normal(uint32_t triangle) const;

  uint32_t triangles() const { return object_.triangleCount(); }
  uint32_t vertices() const { return object_.vertexCount; }
  const Bounds& bounds() const { return bounds_; }

 private:
  vec3 position(uint32_t vertex) const {
    return scene_.localPositions[object_.firstVertex + vertex] * shape_.scale;
  }
  vec3 cross(uint32_t triangle) const;

  const RenderScene& scene_;
  const RenderObject& object_;
  ShapeKey shape_;
  Bounds bounds_;
};

// Numbers samples: one for each place and normal.
class SampleKeys {
 public:
  // The number of the sample there, and whether it is new.
  std::pair<uint32_t, bool> find(const vec3& position, const vec3& normal) {
    const auto [it, isNew] = ids_.emplace(Key{position, normal}, next_);
    if (isNew) ++next_;
    return {it->second, isNew};
  }
  // The same if there is one, otherwise kNone.
  int known(const vec3& position, const vec3& normal) const {
    const auto it = ids_.find(Key{position, normal});
    return it == ids_.end() ? kNone : static_cast<int>(it->second);
  }
  uint32_t addUnnamed() { return next_++; }

 private:
  struct Key {
    vec3 position, normal;
    bool operator==(const Key&) const = default;
  };
  struct Hash {
    size_t operator()(const Key& k) const {
      const auto word = [](const vec3& v) {
        // Adding 0 makes a negative zero positive: both compare equal.
        return hash4(std::bit_cast<uint32_t>(v.x + 0.0f), std::bit_cast<uint32_t>(v.y + 0.0f),
                     std::bit_cast<uint32_t>(v.z + 0.0f), 0u);
      };
      return size_t{word(k.position)} << 32 | word(k.normal);
    }
  };
  std::unordered_map<Key, uint32_t, Hash> ids_;
  uint32_t next_ = 0;
};

}  // namespace lamplighter
