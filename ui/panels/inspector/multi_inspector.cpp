// The inspector while several objects are selected. It shows their common values, and "mixed" where
// they differ. Each edit applies to all of them, as one undo step.
#include <algorithm>
#include <cmath>
#include <functional>

#include <imgui.h>
// For mixed values, which imgui.h of 1.86 does not declare.
#include <imgui_internal.h>

#include "editor/edits/object_edits.h"
#include "editor/edits/tree.h"
#include "editor/lights/light_edits.h"
#include "renderer/base/error.h"
#include "ui/panels/panels.h"
#include "ui/widgets/colour_fields.h"

namespace lamplighter {
namespace {

// Shows errors in the status line.
void attempt(const PanelContext& ui, const std::function<void()>& edit) {
  try {
    edit();
  } catch (const InputError& e) {
    ui.session.setStatus(e.what());
  }
}

// A number field that shows "mixed" until it is dragged or the user types a value. Returns true if
// it changed.
bool mixedField(const PanelContext& ui, const std::string& widget, bool isMixed, float& value,
                float speed, const char* format, float least = 0.0f, float most = 0.0f) {
  return dragField(ui, widget, value, speed, isMixed ? "mixed" : format, least, most);
}

void vectorRow(const PanelContext& ui, const char* label, const std::string& name, float speed,
               const char* format, const char* help) {
  labelledRow(ui, label, help);
  const float gap = ui.px(5), whole = ImGui::GetContentRegionAvail().x;
  const float width = std::floor((whole - 2 * gap) / 3);
  int index = 0;
  for (const char* axis : {".x", ".y", ".z"}) {
    const ObjectProperty& property = objectProperty(name + axis);
    const Document& document = ui.session.document();
    const auto common = commonNumber(document, property);
    float value = common.value_or(property.of(*document.scene.find(document.active())));
    if (index > 0) ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(index < 2 ? width : whole - 2 * (width + gap));
    const bool changed = mixedField(ui, name + axis, !common, value, speed, format);
    trackEdit(ui, "Set " + name + axis);
    if (changed) setNumber(ui.session.editing(), property, value);
    ++index;
  }
}

// A switch of all selected nodes; half on if they differ.
template <typename Of>
bool mixedCheckbox(const PanelContext& ui, const char* label, const std::string& widget, Of of,
                   bool& value) {
  const Document& document = ui.session.document();
  size_t on = 0;
  for (const NodeId id : document.selection) on += of(*document.scene.find(id));
  value = on == document.selection.size();
  ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, on > 0 && !value);
  const bool clicked = ImGui::Checkbox(label, &value);
  ImGui::PopItemFlag();
  ui.name(widget);
  return clicked;
}

void objectFields(const PanelContext& ui) {
  vectorRow(ui, "Position", "position", 0.01f, "%.3f", "In metres, relative to each one's parent.");
  vectorRow(ui, "Rotation", "rotation", 0.5f, "%.1f\u00b0", "In degrees, about X, then Y, then Z.");
  vectorRow(ui, "Scale", "scale", 0.01f, "%.3f", "");
  labelledRow(ui, "In the view", "Locked objects cannot be picked or moved in the viewport.");
  bool value = false;
  if (mixedCheckbox(
          ui, "Shown", "visible", [](const Node& n) { return n.visible; }, value))
    attempt(ui, [&] {
      editSelected(
          ui.session.editing(), value ? "Show" : "Hide", [](const Node&) { return true; },
          [&](Node& n) { n.visible = value; });
    });
  ImGui::SameLine(0, ui.px(14));
  if (mixedCheckbox(
          ui, "Locked", "locked", [](const Node& n) { return n.locked; }, value))
    setLocked(ui.session.editing(), std::vector<NodeId>(ui.session.document().selection), value);
}

void lightFields(const PanelContext& ui, const std::vector<LightSource>& lights) {
  const Scene& scene = ui.session.document().scene;
  size_t on = 0, solo = 0;
  for (const LightSource& l : lights) {
    on += stateOf(scene, l).on;
    solo += stateOf(scene, l).solo;
  }
  const auto flag = [&](const char* label, const char* action, size_t count) {
    bool value = count == lights.size();
    ImGui::PushItemFlag(ImGuiItemFlags_MixedValue, count > 0 && !value);
    if (ImGui::Checkbox(label, &value))
      ui.session.runAction(std::string(action) + (value ? " true" : " false"));
    ImGui::PopItemFlag();
    ui.name(action);
  };
  labelledRow(ui, "Shine",
              "A light that is off does not emit. While any light is solo, only lights that are "
              "solo emit.");
  flag("On", "lights.on", on);
  ImGui::SameLine(0, ui.px(14));
  flag("Solo", "lights.solo", solo);

  labelledRow(ui, "Colour", "Linear colour of all selected lights. Their strength stays the same.");
  vec3 colour = split(emissionOf(scene, lights.back())).colour;
  if (colourField(ui, "lights.colour", "Change colour of lights", colour) &&
      luminance(colour) > 0.0f)
    attempt(ui, [&] { colourLights(ui.session.editing(), colour); });
  for (const LightPropertyInfo& info : lightProperties()) {
    const LightUnit shown = ui.session.lighting().unit;
    const CommonValue common = commonValue(
        ui.session.document().scene, selectedLights(ui.session.document()), info.property, shown);
    if (common.count == 0) continue;
    const bool isIntensity = info.property == LightProperty::intensity;
    const LightUnit unit = common.unitOr(shown);
    const std::string symbol = isIntensity ? unitSymbol(unit) : info.unit;
    const std::string format = isIntensity || info.property == LightProperty::temperature
                                   ? "%.4g " + symbol
                                   : "%.3g " + symbol;
    labelledRow(ui, info.label);
    const bool isMixed = common.isMixed || common.hasMixedUnits;
    float value = static_cast<float>(common.most);
    const bool changed = mixedField(ui, std::string("lights.") + info.name, isMixed, value,
                                    std::max(0.01f, 0.01f * value), format.c_str(),
                                    static_cast<float>(info.least), static_cast<float>(info.most));
    trackEdit(ui, std::string("Change ") + info.name + " of lights");
    if (changed)
      attempt(ui, [&] {
        editLights(ui.session.editing(), LightOperation::set, info.property,
                   static_cast<double>(value), unit);
      });
  }
}

void materialFields(const PanelContext& ui, const std::vector<int>& materials) {
  const auto materialAt = [&](int i) -> const Material& {
    return ui.session.document().scene.materials[static_cast<size_t>(i)];
  };
  labelledRow(ui, "Base colour", "Albedo of the surfaces.");
  vec3 base(materialAt(materials.back()).baseColor);
  if (colourField(ui, "materials.colour", "Change colour of objects", base))
    editMaterials(ui.session.editing(), "Change colour",
                  [&](Material& m) { m.baseColor = vec4(base, m.baseColor.a); });
  const auto number = [&](const char* label, const char* widget, float Material::*of) {
    const float first = materialAt(materials.front()).*of;
    const bool isMixed = std::any_of(materials.begin(), materials.end(),
                                     [&](int i) { return materialAt(i).*of != first; });
    float value = materialAt(materials.back()).*of;
    labelledRow(ui, label);
    const bool changed = mixedField(ui, widget, isMixed, value, 0.005f, "%.2f", 0.0f, 1.0f);
    trackEdit(ui, std::string("Change ") + label);
    if (changed)
      editMaterials(ui.session.editing(), std::string("Change ") + label,
                    [&](Material& m) { m.*of = std::clamp(value, 0.0f, 1.0f); });
  };
  number("Roughness", "materials.roughness", &Material::roughness);
  number("Metallic", "materials.metallic", &Material::metallic);
  note(materials.size() == 1 ? std::string("They share one material.")
                             : std::to_string(materials.size()) + " materials.");
}

void meshKindField(const PanelContext& ui) {
  const Document& document = ui.session.document();
  std::optional<MeshKind> common;
  bool isMixed = false, any = false;
  for (const NodeId id : document.selection) {
    const Node& n = *document.scene.find(id);
    if (n.mesh == kNone) continue;
    isMixed |= any && common != n.meshKind;
    common = n.meshKind;
    any = true;
  }
  if (!any) return;
  labelledRow(ui, "Lit as",
              "Simple: light maps, which cost memory. Complex: per pixel, which costs time in each "
              "frame. Automatic decides for each part of a mesh.");
  const auto kinds = meshKindItems();
  const int current = isMixed ? kNone : static_cast<int>(*common);
  const int chosen = combo(ui, "lit_as", isMixed ? "mixed" : kinds[current].label, kinds, current);
  if (chosen != kNone) ui.session.runAction("objects.lit_as " + kinds[chosen].name);
}

}  // namespace

void multiInspector(PanelContext ui, InspectorState& state) {
  ui.prefix = "inspector/";
  state.node = kNoNode;  // forces a refresh for the next node
  note(std::to_string(ui.session.document().selection.size()) +
       " objects are selected. Values set here apply to all of them.");
  ImGui::PushID("many");
  if (section(ui, "Objects")) objectFields(ui);
  const std::vector<LightSource> lights = selectedLights(ui.session.document());
  if (!lights.empty() && section(ui, "Lights")) lightFields(ui, lights);
  if (!lights.empty() && section(ui, "Light linking")) selectedLinkFields(ui);
  const std::vector<int> materials = selectedMaterials(ui.session.document());
  if (!materials.empty() && section(ui, "Materials")) {
    meshKindField(ui);
    materialFields(ui, materials);
  }
  ImGui::PopID();
}

}  // namespace lamplighter
