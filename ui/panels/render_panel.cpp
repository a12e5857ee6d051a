#include <algorithm>

#include "editor/budgets/memory_limit.h"
#include "editor/presets/presets.h"
#include "renderer/registry/registry.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

// Parameters that are not in the section of their group, because they come first.
constexpr std::string_view kFirst[] = {"bounces", "frame_time"};
constexpr int kMostMemory = 65536;  // of the slider [MiB]

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

// Buttons of presets side by side. The active one is highlighted.
void qualityRow(const PanelContext& ui, Requests& requests) {
  labelledRow(ui, "Quality",
              "Sets the number of light samples, the size and memory of shadow maps, antialiasing "
              "and repair at once, as one undo step.");
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

// All memory limits of the method in one, and what is used of them.
void memoryRow(const PanelContext& ui, const MethodInfo& method) {
  const MemoryRange range = memoryRange(method);
  if (range.most == 0) return;
  const std::string& help = ui.session.actions().find("render.memory")->help;
  labelledRow(ui, "Memory", help.c_str());
  RenderSettings render = ui.session.document().render;
  int total = memoryLimit(method, render.values);
  const int most = std::max(total, std::min(range.most, kMostMemory));
  const bool isSet = valueSlider("##memory", total, range.least, most, "%d MiB",
                                 ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  ui.name("memory");
  trackEdit(ui, "Change memory");
  tooltip(ui, help + " Ctrl+click to type a value. Under Budgets each limit can be set by itself.");
  if (isSet) {
    render.values = withMemoryLimit(method, render.values, total);
    ui.session.setRender(render);
  }
  const uint64_t used = memoryUsed(method, ui.session.output().stats) >> 20;
  rightAligned(grouped(static_cast<long long>(used)) + " MiB used", theme::kTextDim);
  ui.name("memory/used");
}

void exposureRow(const PanelContext& ui) {
  labelledRow(ui, "Exposure",
              "Exposure in EV: each step of 1 doubles the brightness of the picture. The lighting "
              "does not change.");
  RenderSettings render = ui.session.document().render;
  const bool exposed = valueSlider("##exposure", render.exposureEv, -16.0f, 16.0f, "%+.2f EV");
  ui.name("exposure");
  trackEdit(ui, "Change exposure");
  if (exposed) ui.session.setRender(render);
}

}  // namespace

// What is set most often comes first, then the method; all other parameters are in sections that
// are closed at first.
void renderPanel(PanelContext ui, TimelineState& state, Requests& requests) {
  ui.prefix = "render/";
  const auto& all = methods();
  const auto found = std::ranges::find(all, ui.session.document().render.method, &MethodInfo::name);
  if (found == all.end()) return;
  const MethodInfo& method = *found;
  qualityRow(ui, requests);
  for (const std::string_view name : kFirst)
    if (const ParameterSpec* spec = findParameter(method.parameters, name))
      parameterRow(ui, method, *spec);
  memoryRow(ui, method);
  exposureRow(ui);

  if (section(ui, "Method")) methodCombo(ui, method);
  for (const ParameterGroup group : kParameterGroups) parameterSection(ui, method, group, kFirst);
  compareSection(ui, requests);
  timelineSection(ui, state, requests);
}

}  // namespace lamplighter
