#include <algorithm>

#include "renderer/methods/gi_method.h"
#include "ui/panels/panels.h"

namespace lamplighter {
namespace {

void methodCombo(const PanelContext& ui, const MethodInfo& current) {
  labelledRow(ui, "Method", current.citation.c_str());
  const bool open = ImGui::BeginCombo("##method", current.label.c_str());
  ui.name("method");
  if (!open) return;
  for (const MethodInfo& method : methods()) {
    if (ImGui::Selectable(method.label.c_str(), method.name == current.name) &&
        method.name != current.name) {
      RenderSettings render = ui.session.document().render;
      render.method = method.name;
      ui.session.setRender(render);
    }
    ui.name("method/" + method.name);
    tooltip(ui, method.citation);
  }
  ImGui::EndCombo();
}

}  // namespace

void renderPanel(PanelContext ui) {
  ui.prefix = "render/";
  const auto& all = methods();
  const auto found = std::find_if(all.begin(), all.end(), [&](const MethodInfo& m) {
    return m.name == ui.session.document().render.method;
  });
  if (found == all.end()) return;
  methodCombo(ui, *found);

  labelledRow(ui, "Exposure", "Doubles the picture's brightness a step.");
  RenderSettings render = ui.session.document().render;
  const bool exposed =
      ImGui::SliderFloat("##exposure", &render.exposureEv, -16.0f, 16.0f, "%+.2f EV");
  ui.name("exposure");
  trackEdit(ui, "Change exposure");
  if (exposed) ui.session.setRender(render);

  for (const ParameterGroup group : kParameterGroups) parameterSection(ui, *found, group);
}

}  // namespace lamplighter
