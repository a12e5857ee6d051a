#include "renderer/scene/gltf/unused_vertices.h"

#include <algorithm>

namespace lamplighter {

namespace {

template <typename T>
void gather(std::vector<T>& attribute, const std::vector<uint32_t>& used) {
  if (attribute.empty()) return;
  std::vector<T> out;
  out.reserve(used.size());
  for (const uint32_t vertex : used) out.push_back(attribute[vertex]);
  attribute = std::move(out);
}

}  // namespace

void dropUnusedVertices(Primitive& primitive) {
  std::vector<bool> isUsed(primitive.positions.size(), false);
  for (const uint32_t i : primitive.indices) isUsed[i] = true;
  const auto count = static_cast<size_t>(std::count(isUsed.begin(), isUsed.end(), true));
  if (count == 0 || 2 * count >= isUsed.size()) return;

  std::vector<uint32_t> used, newIndex(isUsed.size(), 0);
  used.reserve(count);
  for (uint32_t v = 0; v < isUsed.size(); ++v) {
    if (!isUsed[v]) continue;
    newIndex[v] = static_cast<uint32_t>(used.size());
    used.push_back(v);
  }
  gather(primitive.positions, used);
  gather(primitive.normals, used);
  gather(primitive.tangents, used);
  gather(primitive.uv0, used);
  gather(primitive.uv1, used);
  gather(primitive.colors, used);
  for (uint32_t& i : primitive.indices) i = newIndex[i];
}

}  // namespace lamplighter
