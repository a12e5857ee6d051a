// The tools as a row of buttons. If space is short, the labels of buttons with well-known icons are
// hidden first. Buttons that still do not fit are in a menu at the end.
#include <functional>
#include <vector>

#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr float kSpacing = 4.0f, kGroupGap = 9.0f;  // design pixels

struct Item {
  std::string widget;
  const char *icon, *label;
  std::string help;
  std::function<void()> run;
  bool on = false, enabled = true;
  bool beginsGroup = false;  // a separator is before it
  int keepsLabel = 0;        // the shrink step (see below) that hides its label
  struct Choice {
    std::string widget;
    const char *icon, *label;
    std::function<void()> run;
  };
  std::vector<Choice> choices = {};  // items of a menu that it opens instead of running an action
  const char* moreLabel = "";        // label of its submenu in the "more" menu
  std::vector<Choice> moreChoices = {};
};
using Items = std::vector<Item>;

// Steps of hiding labels: none; of the tools that inspect the picture; of lights and undo; all.
constexpr int kShrinkSteps = 4;

bool showsLabel(const Item& item, int step) {
  return !theme::hasIcons() || step <= item.keepsLabel;
}

std::string textOf(const Item& item, int step) {
  return withIcon(item.icon, showsLabel(item, step) ? item.label : "");
}

float widthOf(const PanelContext& ui, const Item& item, int step) {
  const float before = item.beginsGroup ? 2 * ui.px(kGroupGap) + ui.px(1) : ui.px(kSpacing);
  return before + ImGui::CalcTextSize(textOf(item, step).c_str()).x +
         2 * ImGui::GetStyle().FramePadding.x;
}

void line(const PanelContext& ui) {
  ImGui::SameLine(0, ui.px(kGroupGap));
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetFrameHeight();
  ImGui::GetWindowDrawList()->AddLine({at.x, at.y + ui.px(3)}, {at.x, at.y + height - ui.px(3)},
                                      theme::colour(theme::kLine));
  ImGui::Dummy({ui.px(1), height});
  ImGui::SameLine(0, ui.px(kGroupGap));
}

void choices(const PanelContext& ui, const Item& item) {
  const auto offer = [&](const std::vector<Item::Choice>& choices) {
    for (const Item::Choice& choice : choices) {
      if (ImGui::MenuItem(withIcon(choice.icon, choice.label).c_str())) choice.run();
      ui.name(choice.widget);
    }
  };
  offer(item.choices);
  if (item.moreChoices.empty()) return;
  ImGui::Separator();
  const bool open = ImGui::BeginMenu(item.moreLabel);
  ui.name(item.moreLabel);
  if (!open) return;
  offer(item.moreChoices);
  ImGui::EndMenu();
}

void button(const PanelContext& ui, const Item& item, int step) {
  ImGui::BeginDisabled(!item.enabled);
  const bool clicked = toggleButton(textOf(item, step) + "##" + item.widget, item.on);
  ImGui::EndDisabled();
  ui.name(item.widget);
  tooltip(ui, showsLabel(item, step) ? item.help : std::string(item.label) + ": " + item.help);
  if (item.choices.empty()) {
    if (clicked) item.run();
    return;
  }
  const std::string popup = "##menu " + item.widget;
  if (clicked) ImGui::OpenPopup(popup.c_str());
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  ImGui::SetNextWindowPos({low.x, high.y + ui.px(2)}, ImGuiCond_Appearing);
  if (!ImGui::BeginPopup(popup.c_str())) return;
  choices(ui, item);
  ImGui::EndPopup();
}

// The menu with the items that did not fit, starting at `first`.
void more(const PanelContext& ui, const Items& items, size_t first) {
  ImGui::SameLine();
  if (ImGui::Button("\u2026##more")) ImGui::OpenPopup("##rest");
  ui.name("more");
  tooltip(ui, "More tools");
  if (!ImGui::BeginPopup("##rest")) return;
  for (size_t i = first; i < items.size(); ++i) {
    const Item& item = items[i];
    if (item.beginsGroup && i > first) ImGui::Separator();
    if (!item.choices.empty()) {
      const bool open = ImGui::BeginMenu(withIcon(item.icon, item.label).c_str());
      ui.name(item.widget);
      if (!open) continue;
      choices(ui, item);
      ImGui::EndMenu();
      continue;
    }
    if (ImGui::MenuItem(withIcon(item.icon, item.label).c_str(), nullptr, item.on, item.enabled))
      item.run();
    ui.name(item.widget);
    tooltip(ui, item.help);
  }
  ImGui::EndPopup();
}

void addTools(const PanelContext& ui, Items& items) {
  struct Tool {
    ToolMode mode;
    const char *name, *icon, *label, *help;
  };
  static constexpr Tool kTools[] = {
      {ToolMode::select, "select", icon::kSelect, "Select", "Pick by clicking"},
      {ToolMode::move, "move", icon::kMove, "Move", "Move the selection"},
      {ToolMode::rotate, "rotate", icon::kRotate, "Rotate", "Rotate the selection"},
      {ToolMode::scale, "scale", icon::kScale, "Scale", "Scale the selection"},
  };
  Session& session = ui.session;
  for (const Tool& tool : kTools) {
    const std::string keys = session.actions().keysOf(std::string("tool.") + tool.name);
    Item item{tool.name, tool.icon, tool.label,
              keys.empty() ? tool.help : std::string(tool.help) + " (" + keys + ")",
              [&session, mode = tool.mode] { session.setTool(mode); }};
    item.on = session.tool() == tool.mode && session.points().tool() == PointTool::none;
    item.keepsLabel = 2;
    items.push_back(std::move(item));
  }
}

void addActions(const PanelContext& ui, Items& items, Requests& requests) {
  const auto add = [&](std::string widget, const char* icon, const char* label, std::string help,
                       std::string action, int keepsLabel) -> Item& {
    items.push_back({std::move(widget), icon, label, std::move(help),
                     [&requests, action] { requests.actions.push_back(action); }});
    items.back().keepsLabel = keepsLabel;
    return items.back();
  };
  struct Named {
    const char *name, *icon, *label;
  };
  Item& light = add("add_light", icon::kLight, "Add light",
                    "Adds a light in front of the camera, or at the next click.", "", 2);
  light.beginsGroup = true;
  light.moreLabel = "Click to place";
  const auto offer = [&](std::vector<Item::Choice>& to, const std::string& action, const char* icon,
                         const char* label) {
    to.push_back(
        {action, icon, label, [&requests, action] { requests.actions.push_back(action); }});
  };
  for (const Named& kind :
       {Named{"rectangle", icon::kRectangle, "Rectangle"}, Named{"disk", icon::kDisk, "Disk"},
        Named{"sphere", icon::kSphere, "Sphere"}, Named{"tube", icon::kTube, "Tube"},
        Named{"spot", icon::kSpot, "Spot"}, Named{"point", icon::kPoint, "Point"},
        Named{"sun", icon::kSun, "Sun"}}) {
    offer(light.choices, std::string("light.add ") + kind.name, kind.icon, kind.label);
    offer(light.moreChoices, std::string("light.place ") + kind.name, kind.icon, kind.label);
  }
  const History& history = ui.session.history();
  const bool canUndo = ui.session.editing().canUndo(), canRedo = ui.session.editing().canRedo();
  Item& undo = add("undo", icon::kUndo, "Undo",
                   canUndo ? "Undo: " + history.undoLabel() : "Nothing to undo", "edit.undo", 1);
  undo.enabled = canUndo;
  undo.beginsGroup = true;
  add("redo", icon::kRedo, "Redo", canRedo ? "Redo: " + history.redoLabel() : "Nothing to redo",
      "edit.redo", 1)
      .enabled = canRedo;
  // Tools that inspect the picture. They run their actions directly.
  for (const Named& seeing : {Named{"tool.explain", icon::kExplain, "Why dark?"},
                              Named{"view.probe", icon::kProbeLight, "Probe"},
                              Named{"tool.measure", icon::kMeasure, "Measure"},
                              Named{"view.histogram", icon::kHistogram, "Histogram"}}) {
    const Action& action = *ui.session.actions().find(seeing.name);
    const bool isFirst = seeing.icon == icon::kExplain;
    Item& item = add(seeing.name, seeing.icon, seeing.label,
                     action.help + (action.shortcut.empty() ? "" : " (" + action.shortcut + ")"),
                     seeing.name, isFirst ? 2 : 0);
    item.on = action.checked(ui.session);
    item.beginsGroup = isFirst;
  }
}

}  // namespace

void toolbar(PanelContext ui, Requests& requests) {
  ui.prefix = "toolbar/";
  Items items;
  addTools(ui, items);
  addActions(ui, items, requests);

  ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.px(kSpacing), ui.px(kSpacing)});
  const float room = ImGui::GetContentRegionAvail().x;
  const auto whole = [&](int step) {
    float width = 0.0f;
    for (const Item& item : items) width += widthOf(ui, item, step);
    return width;
  };
  int step = 0;
  while (step + 1 < kShrinkSteps && whole(step) > room) ++step;
  const bool fits = whole(step) <= room;
  // width of the "more" button
  float used = fits ? 0.0f : ImGui::GetFrameHeight() + ui.px(kSpacing);
  size_t shown = 0;
  for (; shown < items.size(); ++shown) {
    const Item& item = items[shown];
    used += widthOf(ui, item, step);
    if (!fits && used > room) break;
    if (item.beginsGroup)
      line(ui);
    else if (shown > 0)
      ImGui::SameLine();
    button(ui, item, step);
  }
  if (shown < items.size()) more(ui, items, shown);
  ImGui::PopStyleVar();
}

}  // namespace lamplighter
