// EXT_lights_area has no sphere or tube lights. They are saved as a node with extras that describe
// the light and an emissive mesh, so that other programs show it; here the mesh is removed again.
// The data of these meshes is marked by extras.lamplighter.sphereLight, and saveGltf() puts it last
// in every list, so that no other index changes.
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/gltf_lights.h"

namespace lamplighter {

namespace {

// Removes the marked entries at the end of a list. A marked entry that another program moved before
// its own entries stays, as an unused mesh.
void dropMarked(Json& root, const char* list) {
  if (!root.contains(list)) return;
  Json& entries = root[list];
  while (!entries.empty() && isMarked(entries.back(), kSphereMark))
    entries.erase(entries.size() - 1);

  if (entries.empty()) root.erase(list);  // glTF has no empty lists
}

// Shortens a buffer, or removes it if it is empty and the last one.
void dropBytes(GltfDocument& document, size_t buffer, size_t begin) {
  Json& root = document.json;
  if (begin == SIZE_MAX) return;
  Json& json = root["buffers"][buffer];
  if (begin == 0) {
    if (buffer + 1 == root["buffers"].size()) {
      root["buffers"].erase(buffer);
      document.buffers.pop_back();
      if (root["buffers"].empty()) root.erase("buffers");
    }
  } else {
    json["byteLength"] = begin;
  }
}

}  // namespace

void stripSphereMeshes(GltfDocument& document) {
  Json& root = document.json;
  bool hasSphere = false;
  if (!root.contains("nodes")) return;
  for (size_t i = 0; i < root["nodes"].size(); ++i) {
    const auto light = readArea(document, i, vec3(1.0f));
    if (!light || !isNotedShape(light->shape)) continue;
    hasSphere = true;
    const Json* mesh = member(root["nodes"][i], "mesh");
    if (mesh != nullptr && isMarked(root["meshes"][mesh->get<size_t>()], kSphereMark)) {
      root["nodes"][i].erase("mesh");
    }
  }
  if (!hasSphere) return;

  // Another program may have used the mesh for its own nodes; then everything stays.
  const Json& meshes = listOf(document, "meshes");
  for (const Json& node : listOf(document, "nodes")) {
    const Json* mesh = member(node, "mesh");
    if (mesh != nullptr && isMarked(meshes[mesh->get<size_t>()], kSphereMark)) return;
  }
  dropMarked(root, "meshes");
  dropMarked(root, "materials");
  dropMarked(root, "accessors");
  if (!root.contains("bufferViews")) {
    checkStructure(document);
    return;
  }
  // The buffer views of sphere meshes are the last ones of the last buffer, so their bytes are
  // removed, too.
  const Json& views = listOf(document, "bufferViews");
  size_t begin = SIZE_MAX, buffer = 0;
  for (size_t i = views.size(); i > 0 && isMarked(views[i - 1], kSphereMark); --i) {
    buffer = views[i - 1]["buffer"].get<size_t>();
    begin = sizeMember(document, views[i - 1], "byteOffset", {"bufferViews", i - 1}).value_or(0);
  }
  dropMarked(root, "bufferViews");
  dropBytes(document, buffer, begin);
  // Marks may be wrong, so the result must be checked.
  checkStructure(document);
}

}  // namespace lamplighter
