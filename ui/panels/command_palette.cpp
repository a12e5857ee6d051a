#include "ui/panels/command_palette.h"

#include <algorithm>
#include <sstream>

#include <imgui_stdlib.h>

#include "renderer/base/text.h"
#include "ui/widgets/theme.h"

namespace lamplighter {

namespace {

constexpr float kPaletteWidth = 560.0f, kListHeight = 300.0f;  // design pixels

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream in(text);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

// 0: no match. Names that start with the text rank above names and labels that contain the words.
int rank(const Action& action, const std::vector<std::string>& words) {
  const std::string name = lowerCase(action.name), label = lowerCase(action.label);
  for (const std::string& word : words) {
    if (name.find(word) == std::string::npos && label.find(word) == std::string::npos) return 0;
  }
  if (words.empty()) return 1;
  if (name.starts_with(words[0]) || label.starts_with(words[0])) return 3;
  const bool startsPart = name.find("." + words[0]) != std::string::npos ||
                          label.find(" " + words[0]) != std::string::npos;
  return startsPart ? 2 : 1;
}

// The action if the text starts with its full name and a space; the rest are arguments.
const Action* namedAction(const ActionRegistry& registry, const std::string& text) {
  const size_t space = text.find(' ');
  return space == std::string::npos ? nullptr : registry.find(text.substr(0, space));
}

}  // namespace

std::vector<const Action*> matchingActions(const ActionRegistry& registry,
                                           const std::string& text) {
  if (const Action* action = namedAction(registry, text)) return {action};
  const std::vector<std::string> words = wordsOf(lowerCase(text));
  std::vector<std::pair<int, const Action*>> found;
  for (const auto& [name, action] : registry.all()) {
    if (const int r = rank(action, words); r > 0) found.emplace_back(r, &action);
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Action*> out;
  for (const auto& [r, action] : found) out.push_back(action);
  return out;
}

void CommandPalette::open(std::string text) {
  text_ = std::move(text);
  chosen_ = 0;
  opening_ = true;
}

std::string CommandPalette::draw(PanelContext ui) {
  ui.prefix = "palette/";
  if (opening_) {
    ImGui::OpenPopup("##palette");
    takesFocus_ = true;
    opening_ = false;
  }
  const ImGuiViewport& window = *ImGui::GetMainViewport();
  ImGui::SetNextWindowPos({window.GetCenter().x, window.Pos.y + 0.16f * window.Size.y},
                          ImGuiCond_Always, {0.5f, 0.0f});
  ImGui::SetNextWindowSize({std::min(ui.px(kPaletteWidth), 0.9f * window.Size.x), 0});
  if (!ImGui::BeginPopup("##palette", ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                                          ImGuiWindowFlags_NoNavInputs))
    return "";
  const auto pressed = [](ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), true);
  };
  if (takesFocus_) ImGui::SetKeyboardFocusHere();
  takesFocus_ = false;
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool isTyped = ImGui::InputTextWithHint("##text", "Type the name of an action", &text_);
  if (isTyped) chosen_ = 0;
  ui.name("text");

  const std::vector<const Action*> found = matchingActions(ui.session.actions(), text_);
  const int last = static_cast<int>(found.size()) - 1;
  const bool down = pressed(ImGuiKey_DownArrow), up = pressed(ImGuiKey_UpArrow);
  chosen_ = std::clamp(chosen_ + (down ? 1 : 0) - (up ? 1 : 0), 0, std::max(last, 0));
  int run = pressed(ImGuiKey_Enter) && last >= 0 ? chosen_ : kNone;

  ImGui::BeginChild("##list", {0, std::min(ui.px(kListHeight), 0.6f * window.Size.y)});
  for (int i = 0; i <= last; ++i) {
    const Action& action = *found[static_cast<size_t>(i)];
    ImGui::PushID(i);
    const bool enabled = (!action.enabled || action.enabled(ui.session)) &&
                         (!action.problem || action.problem(ui.session).empty());
    const std::string label =
        action.label + (action.needsArguments() || action.asksIn(ui.session) ? "\u2026" : "");
    if (ImGui::Selectable("##item", i == chosen_)) run = i;
    ui.name(action.name);
    if (i == chosen_ && (down || up)) ImGui::SetScrollHereY();
    ImGui::SameLine(0, 0);
    colouredText(label, enabled ? theme::kText : theme::kTextDim);
    ImGui::SameLine(ui.px(250));
    colouredText(action.name, theme::kTextDim);
    const float width = ImGui::CalcTextSize(action.shortcut.c_str()).x;
    ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
    colouredText(action.shortcut, theme::kTextDim);
    ImGui::PopID();
  }
  if (found.empty()) note("No action with this name.");
  ImGui::EndChild();
  ImGui::Separator();
  const Action* shown = last >= 0 ? found[static_cast<size_t>(chosen_)] : nullptr;
  note(shown == nullptr ? " " : shown->help);
  note(shown == nullptr || shown->usage.empty() ? " " : shown->name + " " + shown->usage);

  std::string out;
  if (run != kNone) {
    const Action& action = *found[static_cast<size_t>(run)];
    const bool isNamed = namedAction(ui.session.actions(), text_) == &action;
    const bool hasArguments = isNamed && wordsOf(text_).size() > 1;
    if (action.needsArguments() && !action.asks && !hasArguments) {
      open(action.name + " ");  // the user types the arguments
      ImGui::CloseCurrentPopup();
    } else {
      out = isNamed ? text_ : action.name;
      ImGui::CloseCurrentPopup();
    }
  }
  if (pressed(ImGuiKey_Escape)) ImGui::CloseCurrentPopup();
  ImGui::EndPopup();
  return out;
}

}  // namespace lamplighter
