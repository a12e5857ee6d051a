// A sphere or tube light has no place in EXT_lights_area. It is saved as a node with extras that
// say what it is and an emissive mesh, so that other programs show it; here the mesh is taken out
// again. What belongs to these meshes is marked by extras.lamplighter.sphereLight, and saveGltf()
// puts it last in every list, so that nothing else changes its index.
#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/gltf_lights.h"

namespace lamplighter {

namespace {

// Drops the marked entries at the end of a list. An entry that
// another program moved to before others of its own stays: it is an unused mesh then.
void dropMarked(Json& root, const char* list) {
  if (!root.contains(list)) return;
  Json& entries = root[list];
  while (!entries.empty() && isMarked(entries.back(), kSphereMark))
    entries.erase(entries.size() - 1);

  if (entries.empty()) root.erase(list);  // glTF has no empty lists
}

// Shortens a buffer, or takes it away when nothing is left and it is the last.
void dropBytes(Json& root, size_t buffer, size_t begin) {
  if (begin == SIZE_MAX) return;
  Json& buffers = root["buffers"];
  if (begin > 0) {
    buffers[buffer]["byteLength"] = begin;
  } else if (buffer + 1 == buffers.size()) {
    buffers.erase(buffer);
    if (buffers.empty()) root.erase("buffers");
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

  // Another program may have given the mesh to nodes of its own; then all stays.
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
  // The views of sphere meshes are the last of the last buffer: their bytes go as well.
  const Json& views = listOf(document, "bufferViews");
  size_t begin = SIZE_MAX, buffer = 0;
  for (size_t i = views.size(); i > 0 && isMarked(views[i - 1], kSphereMark); --i) {
    buffer = views[i - 1]["buffer"].get<size_t>();
    begin = sizeIn(views[i - 1], "byteOffset");
  }
  dropMarked(root, "bufferViews");
  dropBytes(root, buffer, begin);
  // Marks can be on anything; what is left has to be whole.
  checkStructure(document);
}

}  // namespace lamplighter
