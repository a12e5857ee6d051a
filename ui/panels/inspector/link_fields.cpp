// Light linking of a light: the list of excluded objects, and controls to add and remove objects.
#include <algorithm>
#include <cctype>

#include <imgui.h>
#include <imgui_stdlib.h>

#include "editor/lights/light_links.h"
#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"

namespace lamplighter {
namespace {

std::string nameOf(const Node& n) { return n.name.empty() ? "(unnamed)" : n.name; }

// One object of the list: a click selects it, the cross removes it from the list.
void entry(const PanelContext& ui, NodeId light, const Node& n) {
  ImGui::PushID(static_cast<int>(n.id));
  const float width = ui.px(30);
  ImGui::PushStyleVar(ImGuiStyleVar_ButtonTextAlign, {0.0f, 0.5f});
  if (ImGui::Button(withIcon(n.mesh == kNone ? icon::kGroup : icon::kMesh, nameOf(n)).c_str(),
                    {ImGui::GetContentRegionAvail().x - width - ui.px(5), 0}))
    ui.session.select({n.id});
  ImGui::PopStyleVar();
  ui.name("links/" + nameOf(n));
  tooltip(ui, "Selects it.");
  ImGui::SameLine(0, ui.px(5));
  const bool taken = ImGui::Button("\u00d7", {width, 0});
  ui.name("links/" + nameOf(n) + "/remove");
  tooltip(ui, "Ends the exclusion: the light illuminates this object again.");
  ImGui::PopID();
  if (taken) leaveOut(ui.session.editing(), {light}, {n.id}, false);
}

bool holds(const std::string& text, const std::string& part) {
  const auto same = [](char a, char b) {
    return std::tolower(static_cast<unsigned char>(a)) ==
           std::tolower(static_cast<unsigned char>(b));
  };
  return std::search(text.begin(), text.end(), part.begin(), part.end(), same) != text.end();
}

void chooser(const PanelContext& ui, NodeId light, const std::vector<NodeId>& leftOut,
             InspectorState& state) {
  if (ImGui::Button("Leave out\u2026", {-FLT_MIN, 0})) {
    state.linkSearch.clear();
    ImGui::OpenPopup("##leave_out");
  }
  ui.name("links/add");
  tooltip(ui,
          "Excludes an object from this light. The object still casts its shadow. You can also "
          "select objects and then, with Ctrl, the light.");
  ImGui::SetNextWindowSize({ui.px(240), ui.px(280)});
  if (!ImGui::BeginPopup("##leave_out")) return;
  ImGui::SetNextItemWidth(-FLT_MIN);
  if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
  ImGui::InputTextWithHint("##search", "Search", &state.linkSearch);
  ui.name("links/search");
  ImGui::BeginChild("objects");
  const Scene& scene = ui.session.document().scene;
  NodeId chosen = kNoNode;
  for (const Node& n : scene.nodes) {
    const bool isThere = std::find(leftOut.begin(), leftOut.end(), n.id) != leftOut.end();
    if (isThere || n.id == light || n.camera != kNone || n.area || n.punctual ||
        !holds(n.name, state.linkSearch))
      continue;
    ImGui::PushID(static_cast<int>(n.id));
    if (ImGui::Selectable(
            withIcon(n.mesh == kNone ? icon::kGroup : icon::kMesh, nameOf(n)).c_str()))
      chosen = n.id;
    ui.name("links/add/" + nameOf(n));
    ImGui::PopID();
  }
  ImGui::EndChild();
  if (chosen != kNoNode) {
    ImGui::CloseCurrentPopup();
    try {
      leaveOut(ui.session.editing(), {light}, {chosen}, true);
    } catch (const std::exception& e) {
      ui.session.setStatus(e.what());
    }
  }
  ImGui::EndPopup();
}

}  // namespace

void linkFields(const PanelContext& ui, NodeId light, InspectorState& state) {
  const Scene& scene = ui.session.document().scene;
  const Node* node = scene.find(light);
  const std::vector<NodeId> leftOut =
      light == kNoNode ? scene.skyLight.leftOut : node->light.leftOut;
  std::vector<Node> there;  // copies, because an edit may replace the document's nodes
  for (const NodeId id : leftOut)
    if (const Node* n = scene.find(id)) there.push_back(*n);
  labelledRow(
      ui, "Leaves out",
      "Objects, with their children, that are excluded from this light. They still cast shadows.");
  ImGui::BeginGroup();
  for (const Node& n : there) entry(ui, light, n);
  chooser(ui, light, leftOut, state);
  ImGui::EndGroup();
}

void selectedLinkFields(const PanelContext& ui) {
  const Document& document = ui.session.document();
  const size_t objects = selectedObjects(document).size();
  const size_t leftOut = leftOutBySelection(document).size();
  const float width = (ImGui::GetContentRegionAvail().x - ui.px(5)) / 2;
  ImGui::BeginDisabled(objects == 0);
  if (ImGui::Button("Leave objects out", {width, 0})) ui.session.runAction("light.exclude");
  ImGui::EndDisabled();
  ui.name("links/exclude");
  tooltip(ui, "Excludes the selected objects from the selected lights.");
  ImGui::SameLine(0, ui.px(5));
  ImGui::BeginDisabled(leftOut == 0);
  if (ImGui::Button("Light them again", {width, 0})) ui.session.runAction("light.include");
  ImGui::EndDisabled();
  ui.name("links/include");
  if (leftOut > 0)
    note(leftOut == 1 ? std::string("One object is left out.")
                      : std::to_string(leftOut) + " objects are left out.");
}

}  // namespace lamplighter
