#include <cmath>

#include <tiny_gltf.h>

#include "renderer/scene/gltf/gltf_content.h"
#include "renderer/scene/gltf/gltf_lights.h"

namespace lamplighter {

namespace {

bool isReasonable(const mat4& m) {
  for (int c = 0; c < 4; ++c) {
    for (int r = 0; r < 4; ++r) {
      if (!(std::abs(m[c][r]) <= 1e9f)) return false;  // also when it is NaN
    }
  }
  return true;
}

// Never empty: a list of nodes shows it. The same whatever the node's index is, which saving may
// change.
std::string nodeName(const tinygltf::Model& model, const tinygltf::Node& node) {
  if (!node.name.empty()) return node.name;
  if (node.mesh >= 0) {
    const std::string& name = model.meshes[static_cast<size_t>(node.mesh)].name;
    return name.empty() ? "mesh" : name;
  }
  return node.camera >= 0 ? "camera" : "node";
}

vec3 vec3Or(const std::vector<double>& v, const vec3& otherwise) {
  return v.empty() ? otherwise : vec3(v[0], v[1], v[2]);
}

}  // namespace

Camera readCamera(const GltfDocument& document, size_t index) {
  const tinygltf::Camera& source = document.model->cameras[index];
  const tinygltf::PerspectiveCamera& lens = source.perspective;
  Camera camera;
  camera.name = source.name;
  camera.yfov = static_cast<float>(lens.yfov);
  camera.aspect = static_cast<float>(lens.aspectRatio);
  camera.znear = static_cast<float>(lens.znear);
  camera.zfar = static_cast<float>(lens.zfar);
  if (!(camera.yfov > 0.0f && camera.yfov < kPi) || camera.aspect < 0.0f ||
      !(camera.znear > 0.0f) || camera.zfar < 0.0f) {
    document.fail(At{"cameras", index}, "has invalid lens parameters");
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
  const tinygltf::Node& source = document.model->nodes[node];
  Transform t;
  if (!source.matrix.empty()) {
    mat4 m;
    for (int i = 0; i < 16; ++i)
      m[i / 4][i % 4] = static_cast<float>(source.matrix[static_cast<size_t>(i)]);
    if (m[0][3] != 0.0f || m[1][3] != 0.0f || m[2][3] != 0.0f || m[3][3] != 1.0f) {
      document.fail(at, "has a matrix whose last row is not 0 0 0 1");
    }
    if (!isReasonable(m)) document.fail(at, "has a matrix with values beyond 1e9");
    return decompose(m);
  }
  t.translation = vec3Or(source.translation, t.translation);
  t.scale = vec3Or(source.scale, t.scale);
  const std::vector<double>& r = source.rotation;
  if (!r.empty()) {
    const quat q(static_cast<float>(r[3]), static_cast<float>(r[0]), static_cast<float>(r[1]),
                 static_cast<float>(r[2]));
    const float square = glm::dot(q, q);
    if (!(square > 1e-12f) || !std::isfinite(square)) {
      document.fail(at, "has a rotation that is not a quaternion");
    }
    // Quaternions of unit length within rounding do not change, so that saving writes the same
    // values.
    t.rotation = std::abs(square - 1.0f) > 1e-5f ? glm::normalize(q) : q;
  }
  return t;
}

Node readNode(const GltfDocument& document, size_t node) {
  const tinygltf::Node& source = document.model->nodes[node];
  const Json& json = listOf(document, "nodes")[node];
  Node n;
  n.sourceNode = static_cast<int>(node);
  n.name = nodeName(*document.model, source);
  n.local = readTransform(document, node);
  n.mesh = source.mesh;
  n.camera = source.camera;
  n.punctual = readPunctual(document, node);
  if (const Json* kind = noteOf(json, kMeshKindNote)) {
    if (*kind == "simple") n.meshKind = MeshKind::simple;
    if (*kind == "complex") n.meshKind = MeshKind::complex;
  }
  if (const Json* locked = noteOf(json, kLockedNote)) n.locked = *locked == true;
  if (const Json* visibility = extensionOf(json, "KHR_node_visibility")) {
    n.visible = flagIn(*visibility, "visible", true);
  }
  return n;
}

std::string sceneName(const GltfDocument& document) {
  const Json* scene = shownScene(document);
  return scene == nullptr ? std::string() : textIn(*scene, "name");
}

std::vector<Node> readNodes(GltfDocument& document) {
  const tinygltf::Model& model = *document.model;
  const std::vector<tinygltf::Node>& list = model.nodes;
  std::vector<int> roots;
  if (!model.scenes.empty()) {
    roots = model.scenes[static_cast<size_t>(model.defaultScene)].nodes;
  } else {
    std::vector<bool> isChild(list.size(), false);
    for (const tinygltf::Node& node : list) {
      for (const int child : node.children) isChild[static_cast<size_t>(child)] = true;
    }
    for (size_t i = 0; i < list.size(); ++i) {
      if (!isChild[i]) roots.push_back(static_cast<int>(i));
    }
    document.warn(list.empty() ? "has no scene and no nodes; it is shown empty"
                               : "has no scene; all of its nodes are shown");
  }

  // Depth first, a stack of its own: levels of a hundred thousand nodes one below the other exist.
  struct Open {
    size_t node;
    NodeId parent;
    mat4 parentWorld;
  };
  std::vector<Open> open;
  for (auto root = roots.rbegin(); root != roots.rend(); ++root) {
    open.push_back({static_cast<size_t>(*root), kNoNode, mat4(1.0f)});
  }
  std::vector<Node> nodes;
  nodes.reserve(list.size());
  while (!open.empty()) {
    const Open next = open.back();
    open.pop_back();
    Node node = readNode(document, next.node);
    const mat4 world = next.parentWorld * toMatrix(node.local);
    if (!isReasonable(world)) {
      document.fail(At{"nodes", next.node},
                    "has a position that is not finite, or farther than 1e9 m");
    }
    node.id = static_cast<NodeId>(nodes.size() + 1);
    node.parent = next.parent;
    node.area = readArea(document, next.node, axisLengths(world));
    const std::vector<int>& children = list[next.node].children;
    for (auto child = children.rbegin(); child != children.rend(); ++child) {
      open.push_back({static_cast<size_t>(*child), node.id, world});
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

}  // namespace lamplighter
