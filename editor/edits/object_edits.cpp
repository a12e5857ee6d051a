#include "editor/edits/object_edits.h"

#include <algorithm>

#include "editor/edits/edits.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

vec3 degreesOf(const Node& n) {
  return glm::degrees(glm::eulerAngles(n.local.rotation)) + vec3(0.0f);  // no "-0.0"
}

void setDegrees(Node& n, int axis, float value) {
  vec3 degrees = degreesOf(n);
  degrees[axis] = value;
  n.local.rotation = glm::normalize(quat(glm::radians(degrees)));
}

}  // namespace

const std::vector<ObjectProperty>& objectProperties() {
  static const std::vector<ObjectProperty> kAll = {
      {"position.x", [](const Node& n) { return n.local.translation.x; },
       [](Node& n, float v) { n.local.translation.x = v; }},
      {"position.y", [](const Node& n) { return n.local.translation.y; },
       [](Node& n, float v) { n.local.translation.y = v; }},
      {"position.z", [](const Node& n) { return n.local.translation.z; },
       [](Node& n, float v) { n.local.translation.z = v; }},
      {"rotation.x", [](const Node& n) { return degreesOf(n).x; },
       [](Node& n, float v) { setDegrees(n, 0, v); }},
      {"rotation.y", [](const Node& n) { return degreesOf(n).y; },
       [](Node& n, float v) { setDegrees(n, 1, v); }},
      {"rotation.z", [](const Node& n) { return degreesOf(n).z; },
       [](Node& n, float v) { setDegrees(n, 2, v); }},
      {"scale.x", [](const Node& n) { return n.local.scale.x; },
       [](Node& n, float v) { n.local.scale.x = v; }},
      {"scale.y", [](const Node& n) { return n.local.scale.y; },
       [](Node& n, float v) { n.local.scale.y = v; }},
      {"scale.z", [](const Node& n) { return n.local.scale.z; },
       [](Node& n, float v) { n.local.scale.z = v; }}};
  return kAll;
}

const ObjectProperty& objectProperty(const std::string& name) {
  for (const ObjectProperty& p : objectProperties())
    if (name == p.name) return p;
  throw InputError(name, "is not a property of objects",
                   "give position, rotation or scale with .x, .y or .z");
}

std::optional<float> commonNumber(const Document& document, const ObjectProperty& property) {
  std::optional<float> common;
  constexpr float kSame = 1e-4f;  // what turning to angles and back leaves
  for (const NodeId id : document.selection) {
    const float value = property.of(*document.scene.find(id));
    if (common && std::abs(value - *common) > kSame * std::max(1.0f, std::abs(value)))
      return std::nullopt;
    if (!common) common = value;
  }
  return common;
}

void setNumber(Editing& editing, const ObjectProperty& property, float value) {
  editSelected(
      editing, std::string("Set ") + property.name, [](const Node&) { return true; },
      [&](Node& n) { property.set(n, value); });
}

std::vector<int> selectedMaterials(const Document& document) {
  std::vector<int> out;
  for (const NodeId id : document.selection) {
    const Node& n = *document.scene.find(id);
    if (n.mesh == kNone) continue;
    for (const Primitive& p : document.scene.meshes[static_cast<size_t>(n.mesh)]->primitives)
      if (p.material != kNone && std::find(out.begin(), out.end(), p.material) == out.end())
        out.push_back(p.material);
  }
  return out;
}

void editMaterials(Editing& editing, const std::string& label,
                   const std::function<void(Material&)>& change) {
  const std::vector<int> materials = selectedMaterials(editing.document());
  if (materials.empty())
    throw InputError("materials", "no selected object has a material",
                     "select objects with a material");
  Transaction edit = editing.begin(label);
  for (const int i : materials) change(edit.material(i));
  edit.commit();
}

void editSelected(Editing& editing, const std::string& label,
                  const std::function<bool(const Node&)>& applies,
                  const std::function<void(Node&)>& change) {
  std::vector<Node> nodes;
  for (const NodeId id : editing.document().selection) {
    const Node& n = *editing.document().scene.find(id);
    if (!applies(n)) continue;
    nodes.push_back(n);
    change(nodes.back());
  }
  if (nodes.empty())
    throw InputError("objects", "no selected object has this property", "select others");
  const std::string what =
      nodes.size() == 1 ? nodes[0].name : std::to_string(nodes.size()) + " objects";
  setNodes(editing, label + " of " + what, std::move(nodes));
}

}  // namespace lamplighter
