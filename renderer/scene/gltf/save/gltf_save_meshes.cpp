#include <algorithm>
#include <unordered_map>

#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

namespace {

constexpr int kVertices = 34962, kIndices = 34963;  // bufferView.target

std::span<const uint8_t> bytesOf(const void* data, size_t size) {
  return {static_cast<const uint8_t*>(data), size};
}

template <typename Vec>
std::span<const float> floatsOf(const std::vector<Vec>& v) {
  return {v.empty() ? nullptr : &v[0][0], v.size() * static_cast<size_t>(Vec::length())};
}

Json newPrimitive(GltfOutput& out, const Primitive& p) {
  Json json = {{"attributes", Json::object()}};
  Json& attributes = json["attributes"];
  attributes["POSITION"] = appendFloats(out, floatsOf(p.positions), 3, true);
  if (!p.normals.empty()) attributes["NORMAL"] = appendFloats(out, floatsOf(p.normals), 3, false);
  if (!p.tangents.empty())
    attributes["TANGENT"] = appendFloats(out, floatsOf(p.tangents), 4, false);
  if (!p.uv0.empty()) attributes["TEXCOORD_0"] = appendFloats(out, floatsOf(p.uv0), 2, false);
  if (!p.uv1.empty()) attributes["TEXCOORD_1"] = appendFloats(out, floatsOf(p.uv1), 2, false);
  if (!p.colors.empty()) attributes["COLOR_0"] = appendFloats(out, floatsOf(p.colors), 4, false);
  json["indices"] = appendIndices(out, p.indices, p.positions.size());
  if (p.material != kNone) json["material"] = p.material;
  return json;
}

bool isSameShape(const Mesh& a, const Mesh& b) {
  return std::equal(a.primitives.begin(), a.primitives.end(), b.primitives.begin(),
                    b.primitives.end(), [](const Primitive& p, const Primitive& q) {
                      return p.positions == q.positions && p.indices == q.indices &&
                             p.normals == q.normals && p.tangents == q.tangents && p.uv0 == q.uv0 &&
                             p.uv1 == q.uv1 && p.colors == q.colors;
                    });
}

// A mesh of the file with other materials; data that Scene does not represent is preserved.
Json withMaterials(Json json, const Mesh& mesh) {
  if (!mesh.name.empty()) json["name"] = mesh.name;
  size_t next = 0;
  for (Json& primitive : json["primitives"]) {
    // Skips primitives that were not loaded, see readMeshes().
    if (primitive.value("mode", 4) < 4 || !primitive["attributes"].contains("POSITION")) continue;
    const int material = mesh.primitives[next++].material;
    primitive.erase("material");
    if (material != kNone) primitive["material"] = material;
  }
  return json;
}

Json newMesh(GltfOutput& out, const Mesh& mesh) {
  const auto& was = out.source.meshes;
  for (size_t i = 0; i < was.size(); ++i) {
    if (isSameShape(*was[i], mesh)) {
      return withMaterials(listOf(out.source.document, "meshes")[i], mesh);
    }
  }
  Json json = Json::object();
  if (!mesh.name.empty()) json["name"] = mesh.name;
  json["primitives"] = Json::array();
  for (const Primitive& p : mesh.primitives) {
    if (!p.positions.empty() && !p.indices.empty()) {  // glTF has no empty accessors
      json["primitives"].push_back(newPrimitive(out, p));
    }
  }
  return json;
}

}  // namespace

size_t appendFloats(GltfOutput& out, std::span<const float> values, size_t components,
                    bool withBounds) {
  const char* types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  Json accessor = {
      {"bufferView", out.appendView(bytesOf(values.data(), values.size_bytes()), kVertices)},
      {"componentType", 5126},
      {"count", values.size() / components},
      {"type", types[components]}};
  if (withBounds) {
    Json low = Json::array(), high = Json::array();
    for (size_t c = 0; c < components; ++c) {
      float least = values[c], most = values[c];
      for (size_t i = c; i < values.size(); i += components) {
        least = std::min(least, values[i]);
        most = std::max(most, values[i]);
      }
      low.push_back(toJson(least));
      high.push_back(toJson(most));
    }
    accessor["min"] = std::move(low);
    accessor["max"] = std::move(high);
  }
  return out.append("accessors", std::move(accessor));
}

size_t appendIndices(GltfOutput& out, std::span<const uint32_t> indices, size_t vertices) {
  Json accessor = {
      {"bufferView", 0}, {"componentType", 5125}, {"count", indices.size()}, {"type", "SCALAR"}};
  if (vertices <= 65535) {  // 65535 itself is not allowed as an index
    const std::vector<uint16_t> narrow(indices.begin(), indices.end());
    accessor["componentType"] = 5123;
    accessor["bufferView"] = out.appendView(bytesOf(narrow.data(), 2 * narrow.size()), kIndices);
  } else {
    accessor["bufferView"] =
        out.appendView(bytesOf(indices.data(), indices.size_bytes()), kIndices);
  }
  return out.append("accessors", std::move(accessor));
}

void saveMeshes(GltfOutput& out) {
  const auto &now = out.scene.meshes, &was = out.source.meshes;
  if (now == was) return;
  std::unordered_map<const Mesh*, size_t> old;
  for (size_t i = 0; i < was.size(); ++i) old[was[i].get()] = i;
  Json meshes = Json::array();
  for (const auto& mesh : now) {
    const auto it = old.find(mesh.get());
    meshes.push_back(it == old.end() ? newMesh(out, *mesh)
                                     : listOf(out.source.document, "meshes")[it->second]);
  }
  // Nodes in other scenes of the file may use meshes that this scene no longer uses.
  for (size_t i = now.size(); i < was.size(); ++i) {
    meshes.push_back(listOf(out.source.document, "meshes")[i]);
  }
  if (!meshes.empty()) out.json["meshes"] = std::move(meshes);
}

}  // namespace lamplighter
