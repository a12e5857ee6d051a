#include <algorithm>

#include "editor/presets/presets.h"
#include "renderer/registry/registry.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

void methodCombo(const PanelContext& ui, const MethodInfo& current) {
  labelledRow(ui, "Method", current.citation.c_str());
  std::vector<ComboItem> items;
  int now = kNone;
  for (const MethodInfo& method : methods()) {
    if (method.name == current.name) now = static_cast<int>(items.size());
    const std::string problem = problemOf(method, ui.session.renderer().backend());
    items.push_back(
        {method.name, method.label, problem.empty() ? method.citation : problem, problem.empty()});
  }
  const int chosen = combo(ui, "method", current.label, items, now);
  if (chosen == kNone || chosen == now) return;
  RenderSettings render = ui.session.document().render;
  render.method = items[static_cast<size_t>(chosen)].name;
  ui.session.setRender(render);
}

// Preset buttons side by side. The active preset is highlighted.
void presetRow(const PanelContext& ui, Requests& requests) {
  labelledRow(ui, "Preset", "Sets all budgets and quality parameters at once, as one undo step.");
  const float gap = ui.px(4);
  const float width = std::floor((ImGui::GetContentRegionAvail().x - 2 * gap) /
                                 static_cast<float>(presets().size()));
  for (const Preset& preset : presets()) {
    if (&preset != &presets().front()) ImGui::SameLine(0, gap);
    const bool holds = hasPreset(ui.session.document().render, preset);
    const bool clicked = toggleButton(preset.label, holds, {width, 0});
    ui.name("preset/" + preset.name);
    tooltip(ui, preset.help);
    if (clicked) requests.actions.push_back("preset." + preset.name);
  }
}

}  // namespace

void renderPanel(PanelContext ui, TimelineState& state, Requests& requests) {
  ui.prefix = "render/";
  const auto& all = methods();
  const auto found = std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) {
    return m.name == ui.session.document().render.method;
  });
  if (found == all.end()) return;
  methodCombo(ui, *found);
  presetRow(ui, requests);

  labelledRow(ui, "Exposure",
              "Exposure in EV: each step of 1 doubles the brightness of the picture. The lighting "
              "does not change.");
  RenderSettings render = ui.session.document().render;
  const bool exposed = valueSlider("##exposure", render.exposureEv, -16.0f, 16.0f, "%+.2f EV");
  ui.name("exposure");
  trackEdit(ui, "Change exposure");
  if (exposed) ui.session.setRender(render);

  for (const ParameterGroup group : kParameterGroups) parameterSection(ui, *found, group);
  compareSection(ui, requests);
  timelineSection(ui, state, requests);
}

}  // namespace lamplighter
