#include <algorithm>
#include <cmath>

#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/gltf_lights.h"

namespace lamplighter {

namespace {

bool isReasonable(const mat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!(std::abs(m[c][r]) <= 1e9f)) return false;  // also for NaN
    }
  }
  return true;
}

// Never empty, because lists show it. Does not depend on the node's index, which may change when
// saving.
std::string nodeName(const GltfDocument& document, const Json& json, At at) {
  std::string name = textMember(document, json, "name", at);
  if (!name.empty()) return name;
  if (const auto mesh = sizeMember(document, json, "mesh", at)) {
    name = textMember(document, listOf(document, "meshes")[*mesh], "name", {"meshes", *mesh});
    return name.empty() ? "mesh" : name;
  }
  return member(json, "camera") != nullptr ? "camera" : "node";
}

}  // namespace

Camera readCamera(const GltfDocument& document, size_t index) {
  const At at{"cameras", index};
  const Json& json = listOf(document, "cameras")[index];
  Camera camera;
  camera.name = textMember(document, json, "name", at);
  if (const Json* lens = member(json, "perspective")) {
    camera.yfov = static_cast<float>(numberMember(document, *lens, "yfov", camera.yfov, at));
    camera.aspect = static_cast<float>(numberMember(document, *lens, "aspectRatio", 0.0, at));
    camera.znear = static_cast<float>(numberMember(document, *lens, "znear", camera.znear, at));
    camera.zfar = static_cast<float>(numberMember(document, *lens, "zfar", 0.0, at));
    if (!(camera.yfov > 0.0f && camera.yfov < kPi) || camera.aspect < 0.0f ||
        !(camera.znear > 0.0f) || camera.zfar < 0.0f) {
      document.fail(at, "has a lens that is none", kExportAgain);
    }
  }
  return camera;
}

std::vector<Camera> readCameras(GltfDocument& document) {
  std::vector<Camera> cameras;
  const Json& list = listOf(document, "cameras");
  for (size_t i = 0; i < list.size(); ++i) {
    cameras.push_back(readCamera(document, i));
    if (member(list[i], "orthographic") != nullptr) {
      document.warn("cameras[" + std::to_string(i) +
                    "] is orthographic, which is not supported; shown in perspective");
    }
  }
  return cameras;
}

Transform readTransform(const GltfDocument& document, size_t node) {
  const At at{"nodes", node};
  const Json& json = listOf(document, "nodes")[node];
  const std::vector<double> matrix = numbersMember(document, json, "matrix", 16, at);
  Transform t;
  if (!matrix.empty()) {
    mat4 m;
    for (int i = 0; i < 16; ++i)
      m[i / 4][i % 4] = static_cast<float>(matrix[static_cast<size_t>(i)]);
    if (m[0][3] != 0.0f || m[1][3] != 0.0f || m[2][3] != 0.0f || m[3][3] != 1.0f) {
      document.fail(at, "has a matrix whose last row is not 0 0 0 1", kExportAgain);
    }
    if (!isReasonable(m)) document.fail(at, "has a matrix beyond 1e9", kExportAgain);
    return decompose(m);
  }
  t.translation = vec3Member(document, json, "translation", t.translation, at);
  t.scale = vec3Member(document, json, "scale", t.scale, at);
  const std::vector<double> r = numbersMember(document, json, "rotation", 4, at);
  if (!r.empty()) {
    const quat q(static_cast<float>(r[3]), static_cast<float>(r[0]), static_cast<float>(r[1]),
                 static_cast<float>(r[2]));
    const float square = glm::dot(q, q);
    if (!(square > 1e-12f) || !std::isfinite(square)) {
      document.fail(at, "has a rotation that is none", kExportAgain);
    }
    // Quaternions that are unit except for rounding stay unchanged, so that saving writes the same
    // values.
    t.rotation = std::abs(square - 1.0f) > 1e-5f ? glm::normalize(q) : q;
  }
  return t;
}

Node readNode(const GltfDocument& document, size_t node) {
  const At at{"nodes", node};
  const Json& json = listOf(document, "nodes")[node];
  Node n;
  n.sourceNode = static_cast<int>(node);
  n.name = nodeName(document, json, at);
  n.local = readTransform(document, node);
  if (const auto mesh = sizeMember(document, json, "mesh", at)) n.mesh = static_cast<int>(*mesh);
  if (const auto camera = sizeMember(document, json, "camera", at)) {
    n.camera = static_cast<int>(*camera);
  }
  n.punctual = readPunctual(document, node);
  if (const Json* kind = noteOf(json, kMeshKindNote)) {
    if (*kind == "simple") n.meshKind = MeshKind::simple;
    if (*kind == "complex") n.meshKind = MeshKind::complex;
  }
  if (const Json* locked = noteOf(json, kLockedNote)) n.locked = *locked == true;
  if (const Json* visibility = extensionOf(json, "KHR_node_visibility")) {
    n.visible = boolMember(document, *visibility, "visible", true, at);
  }
  return n;
}

std::string sceneName(const GltfDocument& document) {
  const Json& scenes = listOf(document, "scenes");
  if (scenes.empty()) return {};
  const At at{"scenes", sizeMember(document, document.json, "scene", {"scenes", 0}).value_or(0)};
  return textMember(document, scenes[at.index], "name", at);
}

std::vector<Node> readNodes(GltfDocument& document) {
  const Json& list = listOf(document, "nodes");
  std::vector<size_t> roots;
  const Json& scenes = listOf(document, "scenes");
  if (!scenes.empty()) {
    const Json& scene =
        scenes[sizeMember(document, document.json, "scene", {"scenes", 0}).value_or(0)];
    if (const Json* nodes = member(scene, "nodes")) roots = nodes->get<std::vector<size_t>>();
  } else {
    std::vector<bool> isChild(list.size(), false);
    for (const Json& node : list) {
      if (const Json* children = member(node, "children")) {
        for (const Json& child : *children) isChild[child.get<size_t>()] = true;
      }
    }
    for (size_t i = 0; i < list.size(); ++i) {
      if (!isChild[i]) roots.push_back(i);
    }
    document.warn(list.empty() ? "holds no scene and no nodes; shown empty"
                               : "holds no scene; all of its nodes are shown");
  }

  // Depth-first traversal with an explicit stack: some levels have chains of a hundred thousand
  // nodes.
  struct Open {
    size_t node;
    NodeId parent;
    mat4 parentWorld;
  };
  std::vector<Open> open;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    open.push_back({*root, kNoNode, mat4(1.0f)});
  }
  std::vector<Node> nodes;
  nodes.reserve(list.size());
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    Node node = readNode(document, next.node);
    const mat4 world = next.parentWorld * toMatrix(node.local);
    if (!isReasonable(world)) {
      document.fail({"nodes", next.node}, "lies at no finite place, or farther than 1e9 m",
                    kExportAgain);
    }
    node.id = static_cast<NodeId>(nodes.size() + 1);
    node.parent = next.parent;
    node.area = readArea(document, next.node, axisLengths(world));
    if (const Json* children = member(list[next.node], "children")) {
      for (auto child = children->rbegin(); child != children->rend(); ++child) {
        open.push_back({child->get<size_t>(), node.id, world});
      }
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace lamplighter
