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

}  // namespace

std::optional<ParameterValue> parameterField(const PanelContext& ui, const ParameterSpec& spec,
                                             const Settings& settings, bool tracks) {
  const std::string id = "##" + spec.name;
  if (std::holds_alternative<bool>(spec.defaultValue)) {
    bool value = settings.boolean(spec);
    const bool changed = ImGui::Checkbox(id.c_str(), &value);
    ui.name(spec.name);
    return changed ? std::optional<ParameterValue>(value) : std::nullopt;
  }
  const auto number = [&](auto value, const char* format) {
    const auto low = static_cast<decltype(value)>(spec.minimum),
               high = static_cast<decltype(value)>(spec.maximum);
    const bool changed = valueSlider(id.c_str(), value, low, high, formatOf(spec, format).c_str(),
                                     sliderFlags(spec));
    ui.name(spec.name);
    if (tracks) trackEdit(ui, "Change " + spec.label);
    return changed ? std::optional<ParameterValue>(std::clamp(value, low, high)) : std::nullopt;
  };
  if (std::holds_alternative<int>(spec.defaultValue)) return number(settings.integer(spec), "%d");
  if (std::holds_alternative<float>(spec.defaultValue)) return number(settings.real(spec), "%.3g");
  const int chosen = combo(ui, spec.name, settings.choice(spec), spec.choices);
  if (chosen == kNone) return std::nullopt;
  return spec.choices[static_cast<size_t>(chosen)];
}

namespace {

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
  // Right-aligned with the field, because some texts are too long to start at its left edge. Always
  // one line, so that the items below do not move when the text changes.
  rightAligned(cost->measured, theme::kTextDim);
  ui.name(spec.name + "/cost");
  tooltip(ui, "Mean over the frames of the last seconds that used this budget. " + cost->buys);
}

// Below a parameter that leaves the choice to the method: what it chose, and why.
void chosenLine(const PanelContext& ui, const ParameterSpec& spec) {
  const auto& chosen = ui.session.output().stats.chosen;
  const auto text = chosen.find(spec.name);
  if (text == chosen.end()) return;
  rightAligned(text->second, theme::kTextDim);
  ui.name(spec.name + "/chosen");
  tooltip(ui, "The choice of the method for this scene, and the reason.");
}

}  // namespace

void parameterRow(const PanelContext& ui, const MethodInfo& method, const ParameterSpec& spec) {
  labelledRow(ui, spec.label.c_str(), spec.help.c_str());
  const auto value = parameterField(ui, spec, ui.session.document().render.values, true);
  tooltip(ui, spec.help + " Ctrl+click to type a value, right-click to reset it.");
  RenderSettings render = ui.session.document().render;
  if (value) {
    render.values.set(spec.name, *value);
    ui.session.setRender(render);
  } else if (resetMenu(ui, spec, render.values.has(spec.name))) {
    render.values.reset(spec.name);
    ui.session.setRender(render);
  }
  chosenLine(ui, spec);
  costLine(ui, method, spec);
}

void parameterSection(const PanelContext& ui, const MethodInfo& method, ParameterGroup group,
                      std::span<const std::string_view> except) {
  const auto& all = method.parameters;
  const auto isInGroup = [&](const ParameterSpec& spec) {
    return spec.group == group && std::ranges::find(except, spec.name) == except.end();
  };
  if (std::none_of(all.begin(), all.end(), isInGroup)) return;
  if (!section(ui, labelOf(group), false)) return;
  for (const ParameterSpec& spec : all)
    if (isInGroup(spec)) parameterRow(ui, method, spec);
}

}  // namespace lamplighter
