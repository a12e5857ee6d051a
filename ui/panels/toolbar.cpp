#include <array>

#include "ui/icons.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"

namespace lamplighter {
namespace {

bool button(const PanelContext& ui, const char* widget, const char* icon, const char* label,
            bool on, bool enabled, const std::string& help) {
  if (on) {
    ImGui::PushStyleColor(ImGuiCol_Button, theme::colour(theme::kAccent, 60));
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kAccent));
  }
  ImGui::BeginDisabled(!enabled);
  const bool clicked = ImGui::Button(withIcon(icon, label).c_str());
  ImGui::EndDisabled();
  if (on) ImGui::PopStyleColor(2);
  ui.name(widget);
  tooltip(ui, help);
  return clicked;
}

void gap(const PanelContext& ui) {
  ImGui::SameLine(0, ui.px(9));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y + ui.px(3)}, {at.x, at.y + height - ui.px(3)},
                                      theme::colour(theme::kLine));
  ImGui::Dummy({1, height});
  ImGui::SameLine(0, ui.px(9));
}

// What tells of the picture. They stand for actions as they are.
void seeingButtons(const PanelContext& ui, Requests& requests) {
  struct Item {
    const char *action, *icon, *label;
  };
  static constexpr std::array kItems = {
      Item{"tool.explain", icon::kExplain, "Why dark?"},
      Item{"view.probe", icon::kProbeLight, "Probe"},
      Item{"tool.measure", icon::kMeasure, "Measure"},
      Item{"view.histogram", icon::kHistogram, "Histogram"},
  };
  for (const Item& item : kItems) {
    if (&item != &kItems.front()) ImGui::SameLine();
    const Action& action = *ui.session.actions().find(item.action);
    // Icons speak for themselves but for the first; a narrow window has room for no more.
    const bool iconAlone = theme::hasIcons() && &item != &kItems.front();
    if (button(ui, item.action, item.icon, iconAlone ? "" : item.label, action.checked(ui.session),
               true, std::string(item.label) + ": " + action.help + " (" + action.shortcut + ")"))
      requests.actions.emplace_back(item.action);
  }
}

}  // namespace

void toolbar(PanelContext ui, Requests& requests) {
  ui.prefix = "toolbar/";
  struct Tool {
    ToolMode mode;
    const char *name, *icon, *label, *help;
  };
  static constexpr std::array kTools = {
      Tool{ToolMode::select, "select", icon::kSelect, "Select", "Pick by clicking (Q)"},
      Tool{ToolMode::move, "move", icon::kMove, "Move", "Move the selection (W)"},
      Tool{ToolMode::rotate, "rotate", icon::kRotate, "Rotate", "Rotate the selection (E)"},
      Tool{ToolMode::scale, "scale", icon::kScale, "Scale", "Scale the selection (R)"},
  };
  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(4), ui.px(4)});
  for (const Tool& tool : kTools) {
    if (tool.mode != ToolMode::select) ImGui::SameLine();
    const bool on = ui.session.tool() == tool.mode && ui.session.points().tool() == PointTool::none;
    if (button(ui, tool.name, tool.icon, tool.label, on, true, tool.help))
      ui.session.setTool(tool.mode);
  }
  gap(ui);
  struct Shape {
    const char *name, *icon, *label;
  };
  static constexpr std::array kShapes = {
      Shape{"rectangle", icon::kRectangle, "Rectangle"},
      Shape{"disk", icon::kDisk, "Disk"},
      Shape{"sphere", icon::kSphere, "Sphere"},
  };
  for (const Shape& shape : kShapes) {
    if (&shape != &kShapes.front()) ImGui::SameLine();
    const std::string name = std::string("light.add ") + shape.name;
    if (button(ui, name.c_str(), shape.icon, shape.label, false, true,
               std::string("Add an area light: a ") + shape.name))
      requests.actions.push_back(name);
  }
  gap(ui);
  const History& history = ui.session.history();
  if (button(ui, "undo", icon::kUndo, "Undo", false, history.canUndo(),
             history.canUndo() ? "Undo: " + history.undoLabel() : "Nothing to undo"))
    requests.actions.emplace_back("edit.undo");
  ImGui::SameLine();
  if (button(ui, "redo", icon::kRedo, "Redo", false, history.canRedo(),
             history.canRedo() ? "Redo: " + history.redoLabel() : "Nothing to redo"))
    requests.actions.emplace_back("edit.redo");
  gap(ui);
  seeingButtons(ui, requests);
  ImGui::PopStyleVar();
}

}  // namespace lamplighter
