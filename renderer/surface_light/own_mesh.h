// The triangles of an object without its rotation and translation, and a lookup of samples by
// position.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>
#include <vector>

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
  // The vertex at a corner of a triangle. Normals on the wrong side are replaced by that of the
  // triangle.
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

// Assigns numbers to samples: one for each position and normal. A hash table with open addressing,
// because a level has hundreds of thousands of samples.
class SampleKeys {
 public:
  // The number of the sample at a position and normal, and whether it is new.
  std::pair<uint32_t, bool> find(const vec3& position, const vec3& normal) {
    if (2 * entries_.size() >= slots_.size()) grow();
    const Key key{position, normal};
    uint32_t& slot = slots_[slotOf(key)];
    if (slot != kFree) return {entries_[slot].id, false};
    slot = static_cast<uint32_t>(entries_.size());
    entries_.push_back({key, next_});
    return {next_++, true};
  }
  // The number if there is such a sample, otherwise kNone.
  int known(const vec3& position, const vec3& normal) const {
    if (slots_.empty()) return kNone;
    const uint32_t slot = slots_[slotOf({position, normal})];
    return slot == kFree ? kNone : static_cast<int>(entries_[slot].id);
  }
  uint32_t addUnnamed() { return next_++; }

 private:
  struct Key {
    vec3 position, normal;
    bool operator==(const Key&) const = default;
  };
  struct Entry {
    Key key;
    uint32_t id;
  };
  static constexpr uint32_t kFree = 0xffffffffu;

  static uint32_t hashOf(const Key& k) {
    // Adding 0 makes a negative zero positive, because both compare equal.
    const auto word = [](const vec3& v, uint32_t seed) {
      return hash4(std::bit_cast<uint32_t>(v.x + 0.0f), std::bit_cast<uint32_t>(v.y + 0.0f),
                   std::bit_cast<uint32_t>(v.z + 0.0f), seed);
    };
    return word(k.position, word(k.normal, 0u));
  }
  // The slot of the key or, without one, the free slot for it.
  size_t slotOf(const Key& key) const {
    const size_t mask = slots_.size() - 1;
    size_t at = hashOf(key) & mask;
    while (slots_[at] != kFree && !(entries_[slots_[at]].key == key)) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    slots_.assign(std::max<size_t>(64, 4 * slots_.size()), kFree);
    for (uint32_t i = 0; i < entries_.size(); ++i) slots_[slotOf(entries_[i].key)] = i;
  }

  std::vector<Entry> entries_;
  std::vector<uint32_t> slots_;  // a power of two of them: indices of entries
  uint32_t next_ = 0;
};

}  // namespace lamplighter
