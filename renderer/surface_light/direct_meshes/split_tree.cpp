#include "renderer/surface_light/direct_meshes/split_tree.h"

#include <algorithm>
#include <bit>

#include "renderer/base/random.h"

namespace lamplighter {

size_t SplitTree::Hash::operator()(const Vertex& v) const {
  const auto word = [&](const vec3& a, uint32_t salt) {
    // Adding 0 makes a negative zero positive, because both compare equal.
    return hash4(std::bit_cast<uint32_t>(a.x + 0.0f), std::bit_cast<uint32_t>(a.y + 0.0f),
                 std::bit_cast<uint32_t>(a.z + 0.0f), salt);
  };
  return size_t{word(v.position, v.leftOutBy)} << 32 | word(v.normal, 0u);
}

uint32_t SplitTree::number(const Vertex& vertex) {
  const auto [it, isNew] = numbers_.emplace(vertex, static_cast<uint32_t>(vertices_.size()));
  if (isNew) vertices_.push_back(vertex);
  return it->second;
}

uint32_t SplitTree::root(const RenderScene& scene, const VisibleTriangles::Triangle& triangle) {
  const uint64_t key = uint64_t{triangle.object} << 32 | uint64_t{triangle.triangle} << 1 |
                       (triangle.isBack ? 1u : 0u);
  const auto known = roots_.find(key);
  if (known != roots_.end()) return known->second;
  const RenderObject& o = scene.objects[triangle.object];
  const uint32_t* indices = &scene.indices[o.firstIndex + 3 * triangle.triangle];
  const vec3 a = scene.positions[indices[0]], b = scene.positions[indices[1]],
             c = scene.positions[indices[2]];
  const vec3 flat = (triangle.isBack ? -1.0f : 1.0f) * glm::normalize(glm::cross(b - a, c - a));
  Node node;
  for (size_t k = 0; k < 3; ++k) {
    vec3 normal = (triangle.isBack ? -1.0f : 1.0f) * scene.normals[indices[k]];
    const float length = glm::length(normal);
    normal = length > 0.0f ? normal / length : flat;
    // Normals on the wrong side are replaced by that of the triangle.
    if (glm::dot(normal, flat) <= 0.0f) normal = flat;
    node.corners[k] = number({scene.positions[indices[k]], normal, o.leftOutBy});
  }
  const auto root = static_cast<uint32_t>(nodes_.size());
  nodes_.push_back(node);
  roots_.emplace(key, root);
  return root;
}

void SplitTree::forgetRoots(std::span<const uint32_t> objects) {
  std::erase_if(roots_, [&](const auto& root) {
    return std::ranges::find(objects, static_cast<uint32_t>(root.first >> 32)) != objects.end();
  });
}

// Equal from both sides of an edge, because the sum of two numbers does not depend on their order.
uint32_t SplitTree::middle(uint32_t a, uint32_t b) {
  const Vertex& va = vertices_[a];
  const Vertex& vb = vertices_[b];
  const vec3 sum = va.normal + vb.normal;
  const float length = glm::length(sum);
  return number(
      {0.5f * (va.position + vb.position), length > 0.0f ? sum / length : va.normal, va.leftOutBy});
}

void SplitTree::split(uint32_t number) {
  Node node = nodes_[number];
  if (node.children != kNone) return;
  for (size_t k = 0; k < 3; ++k)
    node.middles[k] = middle(node.corners[k], node.corners[(k + 1) % 3]);
  node.children = static_cast<uint32_t>(nodes_.size());
  nodes_[number] = node;
  const auto& c = node.corners;
  const auto& m = node.middles;
  for (const auto& corners : {std::array{c[0], m[0], m[2]}, std::array{m[0], c[1], m[1]},
                              std::array{m[2], m[1], c[2]}, std::array{m[1], m[2], m[0]}}) {
    Node child;
    child.corners = corners;
    nodes_.push_back(child);
  }
}

size_t SplitTree::bytes() const {
  // Each entry of a map needs a node with key, value and link, and an entry of the table.
  constexpr size_t kEntry = 3 * sizeof(void*);
  return vertices_.size() * (2 * sizeof(Vertex) + kEntry) + nodes_.size() * sizeof(Node) +
         roots_.size() * kEntry;
}

}  // namespace lamplighter
