#include <algorithm>

#include "editor/budgets/budget_costs.h"
#include "renderer/methods/gi_method.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

ImGuiSliderFlags sliderFlags(const ParameterSpec& spec) {
  return ImGuiSliderFlags_AlwaysClamp | (spec.logarithmic ? ImGuiSliderFlags_Logarithmic : 0);
}

// "%d" or "%.3g" with the unit; a % in the unit is doubled for printf.
std::string formatOf(const ParameterSpec& spec, const char* number) {
  std::string format = number;
  if (spec.unit.empty()) return format;
  format += ' ';
  for (const char c : spec.unit) {
    format += c;
    if (c == '%') format += c;
  }
  return format;
}

// Draws a field from the declaration of the parameter. Returns the new value if it changed.
std::optional<ParameterValue> parameterField(const PanelContext& ui, const ParameterSpec& spec,
                                             const Settings& settings) {
  const std::string id = "##" + spec.name;
  const std::string step = "Change " + spec.label;
  if (std::holds_alternative<bool>(spec.defaultValue)) {
    bool value = settings.boolean(spec);
    const bool changed = ImGui::Checkbox(id.c_str(), &value);
    ui.name(spec.name);
    return changed ? std::optional<ParameterValue>(value) : std::nullopt;
  }
  if (std::holds_alternative<int>(spec.defaultValue)) {
    int value = settings.integer(spec);
    const auto low = static_cast<int>(spec.minimum), high = static_cast<int>(spec.maximum);
    const bool changed =
        valueSlider(id.c_str(), value, low, high, formatOf(spec, "%d").c_str(), sliderFlags(spec));
    ui.name(spec.name);
    trackEdit(ui, step);
    return changed ? std::optional<ParameterValue>(std::clamp(value, low, high)) : std::nullopt;
  }
  if (std::holds_alternative<float>(spec.defaultValue)) {
    float value = settings.real(spec);
    const auto low = static_cast<float>(spec.minimum), high = static_cast<float>(spec.maximum);
    const bool changed = valueSlider(id.c_str(), value, low, high, formatOf(spec, "%.3g").c_str(),
                                     sliderFlags(spec));
    ui.name(spec.name);
    trackEdit(ui, step);
    return changed ? std::optional<ParameterValue>(std::clamp(value, low, high)) : std::nullopt;
  }
  const std::string value = settings.choice(spec);
  std::optional<ParameterValue> chosen;
  const bool open = ImGui::BeginCombo(id.c_str(), value.c_str());
  ui.name(spec.name);
  if (open) {
    for (const std::string& choice : spec.choices) {
      if (ImGui::Selectable(choice.c_str(), choice == value)) chosen = choice;
      ui.name(spec.name + "/" + choice);
    }
    ImGui::EndCombo();
  }
  return chosen;
}

// A right-click menu that resets a parameter to its default.
bool resetMenu(const PanelContext& ui, const ParameterSpec& spec, bool isSet) {
  bool reset = false;
  if (ImGui::BeginPopupContextItem(("reset " + spec.name).c_str())) {
    reset = ImGui::MenuItem("Reset to default", nullptr, false, isSet);
    ui.name(spec.name + "/reset");
    ImGui::EndPopup();
  }
  return reset;
}

// Below the slider of a budget: its cost in the last seconds. The tooltip shows its benefit.
void costLine(const PanelContext& ui, const MethodInfo& method, const ParameterSpec& spec) {
  const auto cost = costOf(spec, method, ui.session.watch().timeline, ui.session.output().stats);
  if (!cost) return;
  const float start = ImGui::GetCursorPosX(), room = ImGui::GetContentRegionAvail().x;
  const float width = ImGui::CalcTextSize(cost->measured.c_str()).x;
  // Right-aligned with the field, because some texts are too long to start at its left edge.
  ImGui::SetCursorPosX(start + std::max(room - width, 0.0f));
  // Always one line, so that the items below do not move when the text changes.
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  ImGui::TextUnformatted(cost->measured.c_str());
  ImGui::PopStyleColor();
  ui.name(spec.name + "/cost");
  tooltip(ui, "Mean of the frames of the last seconds that drew upon this budget. " + cost->buys);
}

void parameterRow(const PanelContext& ui, const MethodInfo& method, const ParameterSpec& spec) {
  labelledRow(ui, spec.label.c_str(), spec.help.c_str());
  const auto value = parameterField(ui, spec, ui.session.document().render.values);
  tooltip(ui, spec.help + " Ctrl+click to type a value, right-click to reset it.");
  RenderSettings render = ui.session.document().render;
  if (value) {
    render.values.set(spec.name, *value);
    ui.session.setRender(render);
  } else if (resetMenu(ui, spec, render.values.has(spec.name))) {
    render.values.reset(spec.name);
    ui.session.setRender(render);
  }
  costLine(ui, method, spec);
}

}  // namespace

void parameterSection(const PanelContext& ui, const MethodInfo& method, ParameterGroup group) {
  const auto& all = method.parameters;
  const auto isInGroup = [&](const ParameterSpec& spec) { return spec.group == group; };
  if (std::none_of(all.begin(), all.end(), isInGroup)) return;
  // The group of the most used parameters is open at first. All groups would not fit the panel.
  const bool openAtFirst = group == ParameterGroup::lightSamples;
  if (!section(ui, labelOf(group), openAtFirst)) return;
  for (const ParameterSpec& spec : all)
    if (isInGroup(spec)) parameterRow(ui, method, spec);
}

}  // namespace lamplighter
