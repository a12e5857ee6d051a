// A sphere light has no place in EXT_lights_area. It is saved as a node with extras that say what
// it is and an emissive mesh, so that other programs show it; here the mesh is taken out again.
// What belongs to these meshes is marked by extras.lamplighter.sphereLight, and saveGltf() puts it
// last in every list, so that nothing else changes its index.
#include "renderer/scene/gltf_content.h"
#include "renderer/scene/gltf_light_names.h"

namespace lamplighter {

namespace {

bool isMarked(const Json& object) {
  const Json* extras = member(object, "extras");
  const Json* ours = extras == nullptr ? nullptr : member(*extras, kExtrasName);
  const Json* mark = ours == nullptr ? nullptr : member(*ours, "sphereLight");
  return mark != nullptr && *mark == true;
}

// Drops the marked entries at the end of a list and gives the number that is left. An entry that
// another program moved to before others of its own stays: it is an unused mesh then.
size_t dropMarked(Json& root, const char* list) {
  if (!root.contains(list)) return 0;
  Json& entries = root[list];
  while (!entries.empty() && isMarked(entries.back())) entries.erase(entries.size() - 1);
  const size_t left = entries.size();
  if (left == 0) root.erase(list);  // glTF has no empty lists
  return left;
}

}  // namespace

void stripSphereMeshes(GltfDocument& document) {
  Json& root = document.json;
  bool hasSphere = false;
  if (!root.contains("nodes")) return;
  for (size_t i = 0; i < root["nodes"].size(); ++i) {
    const auto light = readArea(document, i, vec3(1.0f));
    if (!light || light->shape != AreaShape::sphere) continue;
    root["nodes"][i].erase("mesh");
    hasSphere = true;
  }
  if (!hasSphere) return;

  // Another program may have given the mesh to nodes of its own; then all stays.
  const Json& meshes = listOf(document, "meshes");
  for (const Json& node : listOf(document, "nodes")) {
    const Json* mesh = member(node, "mesh");
    if (mesh != nullptr && isMarked(meshes[mesh->get<size_t>()])) return;
  }
  dropMarked(root, "meshes");
  dropMarked(root, "materials");
  dropMarked(root, "accessors");
  if (!root.contains("bufferViews")) return;
  // The views of sphere meshes are the last of the last buffer: their bytes go as well.
  const Json& views = listOf(document, "bufferViews");
  size_t begin = SIZE_MAX, buffer = 0;
  for (size_t i = views.size(); i > 0 && isMarked(views[i - 1]); --i) {
    buffer = views[i - 1]["buffer"].get<size_t>();
    begin = sizeMember(document, views[i - 1], "byteOffset", {"bufferViews", i - 1}).value_or(0);
  }
  dropMarked(root, "bufferViews");
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

}  // namespace lamplighter
