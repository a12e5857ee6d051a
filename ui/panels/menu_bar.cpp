#include <algorithm>
#include <sstream>

#include "editor/actions/arguments.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

// The order within menus. "-" is a separator, ">NAME" starts a submenu, and "<" ends it. Unlisted
// actions follow at the end of the menu of their group, so that every action can be reached.
struct Menu {
  const char* title;
  std::vector<std::string> groups;  // first parts of action names
  std::vector<std::string> first;
};

constexpr const char *kEngineMenu = ">Engine", *kMethodMenu = ">Method", *kSplitMenu = ">Compare";

std::vector<std::string> viewActions() {
  std::vector<std::string> names;
  const auto add = [&](std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
  };
  const auto addViews = [&](bool engine, bool method) {
    for (const DebugViewInfo& info : debugViews())
      if (isOfEngine(info.view) == engine && info.method.empty() != method)
        names.push_back(std::string("view.") + info.name);
  };
  addViews(false, false);
  add({kEngineMenu});
  addViews(true, false);
  add({"view.choose_light", "view.choose_vpl", "<", kMethodMenu});
  addViews(true, true);
  add({"<", "-"});
  add({"view.false_colour_unit", "view.false_colour_range", "-"});
  add({"view.vpls", "view.probes", "view.probe_grid", "view.probe", "view.histogram"});
  add({"view.tone_mapper", "-", "split.on", "split.tiles"});
  add({kSplitMenu, "split.show", "split.toggle", "split.heat", "split.heat_scale"});
  add({"split.position", "split.export", "split.off", "<", "-"});
  add({">Camera", "view.frame_all", "view.frame_selection", "-", "camera.go"});
  add({"bookmark.go", "bookmark.store", "bookmark.clear", "<"});
  add({">Window", "panel.assets", "panel.log", "panel.next", "panel.previous"});
  add({"view.ui_scale", "<", "view.work_light"});
  return names;
}

const std::vector<Menu>& menus() {
  static const std::vector<Menu> kMenus = {
      {"File",
       {"file", "app", "recovery"},
       {"file.new", "file.open", "file.open_recent", "-", "file.save", "file.save_as", "-"}},
      {"Edit",
       {"edit", "selection", "select", "history", "settings"},
       {"edit.undo", "edit.redo", "panel.history", "-", "edit.duplicate", "edit.delete",
        "edit.rename"}},
      {"Light", {"light", "lights"}, {"light.add", "light.place", "-", "panel.lights"}},
      {"Object", {"object", "objects", "materials", "node", "place", "asset"}, {}},
      {"Tool", {"tool"}, {"tool.select", "tool.move", "tool.rotate", "tool.scale"}},
      {"View", {"view", "camera", "bookmark", "panel", "split"}, viewActions()},
      {"Inspect",
       {"explain", "probe", "measure"},
       {"explain.pointer", "tool.explain", "explain.close", "-", "tool.measure", "measure.clear"}},
      {"Render",
       {"render", "preset", "error", "timeline"},
       {"render.reference", "render.auto_exposure", "-", "preset.draft", "preset.work",
        "preset.final", "-", "error.meter", "error.block", "-"}},
  };
  return kMenus;
}

std::string groupOf(const std::string& name) { return name.substr(0, name.find('.')); }

// "rectangle|disk|sphere": returns each choice.
std::vector<std::string> choicesOf(const std::string& usage) {
  std::vector<std::string> choices;
  if (usage.find('|') == std::string::npos || usage.find(' ') != std::string::npos) return choices;
  std::string plain;
  std::copy_if(usage.begin(), usage.end(), std::back_inserter(plain),
               [](char c) { return c != '[' && c != ']' && c != '<' && c != '>'; });
  std::istringstream in(plain);
  for (std::string choice; std::getline(in, choice, '|');) choices.push_back(choice);
  return choices;
}

std::vector<ActionChoice> choicesNow(const Session& session, const Action& action) {
  if (action.choices) return action.choices(session);
  std::vector<ActionChoice> out;
  for (const std::string& choice : choicesOf(action.usage)) {
    std::string label = choice;
    if (label.size() > 2)  // lm and cd are not words
      label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    out.push_back({choice, label});
  }
  return out;
}

// Whether the user types the arguments in the palette. Other actions ask for them with a dialog, or
// have a submenu of choices.
bool isTyped(const Action& action) {
  return action.needsArguments() && !action.asks && !action.choices &&
         choicesOf(action.usage).empty();
}

void menuItem(const PanelContext& ui, const Action& action, Requests& requests) {
  const bool enabled = !action.enabled || action.enabled(ui.session);
  const char* shortcut = action.shortcut.empty() ? nullptr : action.shortcut.c_str();
  if (action.choices || !choicesOf(action.usage).empty()) {
    const std::vector<ActionChoice> choices = choicesNow(ui.session, action);
    const bool open = ImGui::BeginMenu(action.label.c_str(), enabled && !choices.empty());
    ui.name(action.name);
    if (!open) return;
    for (const ActionChoice& choice : choices) {
      const bool isWord = choice.argument.find_first_of(" \"\\") == std::string::npos;
      const std::string text =
          action.name + " " + (isWord ? choice.argument : quoted(choice.argument));
      const std::string keys = ui.session.actions().keysOf(text);
      const std::string label = choice.label + "##" + choice.argument;
      if (ImGui::MenuItem(label.c_str(), keys.empty() ? nullptr : keys.c_str()))
        requests.actions.push_back(text);
      ui.name(text);
    }
    ImGui::EndMenu();
    return;
  }
  const bool checked = action.checked && action.checked(ui.session);
  const bool asks = isTyped(action) || action.asksIn(ui.session);
  const std::string label = action.label + (asks ? "\u2026" : "");
  const std::string problem = action.problem ? action.problem(ui.session) : "";
  if (!problem.empty()) ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  const bool isChosen = ImGui::MenuItem(label.c_str(), shortcut, checked, enabled);
  if (!problem.empty()) ImGui::PopStyleColor();
  if (isChosen) {
    if (isTyped(action))
      requests.palette = action.name + " ";
    else
      requests.actions.push_back(action.name);
  }
  ui.name(action.name);
  tooltip(ui,
          problem.empty() ? action.help : action.help + " Nothing to show now: " + problem + ".");
}

void drawMenu(const PanelContext& ui, const Menu& menu, Requests& requests) {
  const auto& all = ui.session.actions().all();
  std::vector<const Action*> rest;
  for (const auto& [name, action] : all) {
    const bool inGroup =
        std::find(menu.groups.begin(), menu.groups.end(), groupOf(name)) != menu.groups.end();
    const bool listed = std::find(menu.first.begin(), menu.first.end(), name) != menu.first.end();
    if (inGroup && !listed) rest.push_back(&action);
  }
  const bool anyListed = std::any_of(menu.first.begin(), menu.first.end(),
                                     [&](const std::string& n) { return all.contains(n); });
  if (!anyListed && rest.empty()) return;
  const bool open = ImGui::BeginMenu(menu.title);
  ui.name(menu.title);
  if (!open) return;
  bool line = false, any = false;
  bool inner = false, innerOpen = false;
  for (const std::string& name : menu.first) {
    if (name.front() == '>') {
      inner = true;
      innerOpen = ImGui::BeginMenu(name.c_str() + 1);
      ui.name(name.substr(1));
      continue;
    }
    if (name == "<") {
      if (innerOpen) ImGui::EndMenu();
      inner = innerOpen = false;
      continue;
    }
    if (inner && !innerOpen) continue;
    if (name == "-") {
      line = any;
      continue;
    }
    const Action* action = ui.session.actions().find(name);
    if (!action) continue;
    if (line) ImGui::Separator();
    line = false;
    any = true;
    menuItem(ui, *action, requests);
  }
  // Actions with typed arguments have their own submenu, so that no menu is taller than the window.
  const auto typed =
      std::stable_partition(rest.begin(), rest.end(), [](const Action* a) { return !isTyped(*a); });
  if (any && !rest.empty()) ImGui::Separator();
  for (auto a = rest.begin(); a != typed; ++a) menuItem(ui, **a, requests);
  if (typed != rest.end()) {
    const bool isOpen = ImGui::BeginMenu("More");
    ui.name(std::string("More ") + menu.title);
    if (isOpen) {
      for (auto a = typed; a != rest.end(); ++a) menuItem(ui, **a, requests);
      ImGui::EndMenu();
    }
  }
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false)) ImGui::CloseCurrentPopup();
  ImGui::EndMenu();
}

}  // namespace

void menuBar(PanelContext ui, Requests& requests) {
  ui.prefix = "menu/";
  if (!ImGui::BeginMainMenuBar()) return;
  for (const Menu& menu : menus()) drawMenu(ui, menu, requests);
  ImGui::EndMainMenuBar();
}

}  // namespace lamplighter
