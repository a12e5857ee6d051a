#include "renderer/scene/gltf/flat_normals.h"

namespace lamplighter {

namespace {

template <typename T>
void repeat(std::vector<T>& attribute, uint32_t vertex) {
  if (!attribute.empty()) attribute.push_back(T(attribute[vertex]));
}

}  // namespace

void addFlatNormals(Primitive& primitive, const std::vector<bool>& missing) {
  constexpr uint32_t kEnd = UINT32_MAX;
  // Faces whose normals differ by less than rounding errors share vertices: cos of 0.08 degrees.
  constexpr float kSameFacing = 0.999999f;

  primitive.normals.resize(primitive.positions.size(), vec3(0.0f, 1.0f, 0.0f));
  // Copies of a vertex form a linked list: nextCopy is the index of the next copy.
  std::vector<uint32_t> nextCopy(primitive.positions.size(), kEnd);
  std::vector<bool> hasNormal(primitive.positions.size());
  for (size_t v = 0; v < missing.size(); ++v) hasNormal[v] = !missing[v];

  for (size_t first = 0; first + 2 < primitive.indices.size(); first += 3) {
    uint32_t* corners = &primitive.indices[first];
    const vec3& a = primitive.positions[corners[0]];
    // In double: with short edges in a large model, the cross product would lose all digits of a
    // float.
    const glm::dvec3 cross = glm::cross(glm::dvec3(primitive.positions[corners[1]] - a),
                                        glm::dvec3(primitive.positions[corners[2]] - a));
    const double length = glm::length(cross);
    if (!(length > 0.0)) continue;  // no area: the face is invisible
    const vec3 normal(cross / length);
    for (int c = 0; c < 3; ++c) {
      uint32_t vertex = corners[c];
      if (vertex < missing.size() && !missing[vertex]) continue;
      while (hasNormal[vertex] && glm::dot(primitive.normals[vertex], normal) < kSameFacing) {
        if (nextCopy[vertex] == kEnd) {
          nextCopy[vertex] = static_cast<uint32_t>(primitive.positions.size());
          nextCopy.push_back(kEnd);
          hasNormal.push_back(false);
          repeat(primitive.positions, vertex);
          repeat(primitive.normals, vertex);
          repeat(primitive.tangents, vertex);
          repeat(primitive.uv0, vertex);
          repeat(primitive.uv1, vertex);
          repeat(primitive.colors, vertex);
        }
        vertex = nextCopy[vertex];
      }
      corners[c] = vertex;
      if (!hasNormal[vertex]) {
        primitive.normals[vertex] = normal;
        hasNormal[vertex] = true;
      }
    }
  }
}

}  // namespace lamplighter
