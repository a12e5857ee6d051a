#include <cmath>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "ui/panels/panels.h"

namespace lamplighter {

std::span<const ComboItem> meshKindItems() {
  static const ComboItem kKinds[] = {{"automatic", "Automatic"},
                                     {"simple", "Simple: light maps"},
                                     {"complex", "Complex: each pixel"}};
  return kKinds;
}

namespace {

const char* kindOf(const Node& node) {
  if (node.area) return "Area light";
  if (node.punctual) {
    switch (node.punctual->kind) {
      case PunctualKind::point:
        return "Point light";
      case PunctualKind::spot:
        return "Spot light";
      case PunctualKind::directional:
        return "Directional light";
    }
  }
  if (node.camera != kNone) return "Camera";
  if (node.mesh != kNone) return "Object";
  return "Group";
}

void nameField(const PanelContext& ui, const Node& node, InspectorState& state) {
  labelledRow(ui, kindOf(node));
  ImGui::InputText("##name", &state.name);
  ui.name("name");
  // The typed text becomes the name only at the end of the edit, so that it is one undo step.
  if (ImGui::IsItemDeactivatedAfterEdit() && !state.name.empty() && state.name != node.name)
    ui.session.setName(node.id, state.name);
  else if (!ImGui::IsItemActive())
    state.name = node.name;
}

void meshKindField(const PanelContext& ui, const Node& node) {
  labelledRow(ui, "Lit as",
              "Simple: planar parts get light maps and exact visibility, which costs memory. "
              "Complex: curved meshes or many small triangles are lit per pixel, which costs time "
              "in each frame. Automatic decides for each part of the mesh.");
  const auto current = static_cast<int>(node.meshKind);
  const auto kinds = meshKindItems();
  const int chosen = combo(ui, "mesh_kind", kinds[current].label, kinds, current);
  if (chosen != kNone && chosen != current)
    ui.session.setMeshKind(node.id, static_cast<MeshKind>(chosen));
}

}  // namespace

void inspector(PanelContext ui, InspectorState& state, Requests& requests) {
  ui.prefix = "inspector/";
  const Document& document = ui.session.document();
  const Node* found = document.scene.find(document.active());
  if (!found) {
    note("Nothing is selected. Click an object in the view or in the list.");
    ImGui::Spacing();
    if (section(ui, "Sky")) skyFields(ui, state, requests);
    return;
  }
  // A copy: an edit below may replace the document's node.
  const Node node = *found;
  if (state.node != node.id) {
    state = {};
    state.node = node.id;
    state.name = node.name;
    state.rotation = quat(0, 0, 0, 0);  // not a rotation: forces the angles to be computed again
  }
  if (document.selection.size() > 1) return multiInspector(ui, state);
  ImGui::PushID(static_cast<int>(node.id));
  nameField(ui, node, state);
  if (section(ui, "Transform")) transformFields(ui, node, state);
  if (node.area && section(ui, "Area light")) areaLightFields(ui, node, requests);
  if (node.punctual && section(ui, "Light")) punctualLightFields(ui, node, requests);
  if (emitsLight(document.scene, node) && section(ui, "Light linking"))
    linkFields(ui, node.id, state);
  if (node.mesh != kNone && section(ui, "Mesh")) meshKindField(ui, node);
  if (node.mesh != kNone && section(ui, "Material")) materialFields(ui, node, state);
  ImGui::PopID();
}

void transformFields(PanelContext ui, const Node& node, InspectorState& state) {
  if (state.rotation != node.local.rotation) {
    state.rotation = node.local.rotation;
    state.degrees = glm::degrees(glm::eulerAngles(state.rotation));
    // Prevents "-0.0" from rounding errors.
    for (int i = 0; i < 3; ++i)
      if (std::abs(state.degrees[i]) < 0.005f) state.degrees[i] = 0.0f;
  }
  Transform local = node.local;
  labelledRow(ui, "Position", "In metres, relative to the parent.");
  if (dragVector(ui, "translation", "Move " + node.name, local.translation, 0.01f, "%.3f"))
    ui.session.setNodeTransform(node.id, local);
  labelledRow(ui, "Rotation", "In degrees, about X, then Y, then Z.");
  vec3 degrees = state.degrees;
  if (dragVector(ui, "rotation", "Rotate " + node.name, degrees, 0.5f, "%.1f\u00b0")) {
    local.rotation = glm::normalize(quat(glm::radians(degrees)));
    state.degrees = degrees;
    state.rotation = local.rotation;
    ui.session.setNodeTransform(node.id, local);
  }
  labelledRow(ui, "Scale", "Along the axes of the object.");
  if (dragVector(ui, "scale", "Scale " + node.name, local.scale, 0.01f, "%.3f"))
    ui.session.setNodeTransform(node.id, local);
}

}  // namespace lamplighter
