// The accuracy of the picture: the error meter, the split view with the choice of its sides, and
// all methods as tiles.
#include <array>
#include <cmath>
#include <cstdio>

#include "renderer/methods/path_tracer/reference_method.h"
#include "renderer/registry/registry.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"
#include "ui/widgets/value_slider.h"

namespace lamplighter {
namespace {

// The predefined sides: live, each method, and each variant of a method.
std::vector<std::string> sides() {
  std::vector<std::string> all{"live"};
  for (const MethodInfo& method : methods()) {
    all.push_back(method.name);
    for (const ParameterSpec& spec : method.parameters)
      if (spec.name == method.variant)
        for (const std::string& choice : spec.choices)
          all.push_back(method.name + "," + spec.name + "=" + choice);
  }
  return all;
}

// Returns the new text if the user chose another one.
std::optional<std::string> sideCombo(const PanelContext& ui, const char* label,
                                     const std::string& widget, const std::string& current) {
  labelledRow(ui, label,
              "live: the picture with the settings of this panel. The action split.on shows any "
              "method with other parameters.");
  const std::vector<std::string> all = sides();
  const int chosen = combo(ui, widget, current, all);
  if (chosen == kNone || all[static_cast<size_t>(chosen)] == current) return std::nullopt;
  return all[static_cast<size_t>(chosen)];
}

void errorRow(const PanelContext& ui, Requests& requests) {
  const ErrorMeter& meter = ui.session.watch().meter;
  labelledRow(ui, "Error meter",
              "Traces the reference in the background and shows the error of the picture. Runs "
              "at low priority, so it takes little time from the editor.");
  bool on = meter.on();
  if (ImGui::Checkbox("##meter", &on)) requests.actions.emplace_back("error.meter");
  ui.name("meter");
  ImGui::SameLine();
  ImGui::TextUnformatted(meter.estimate() ? meter.estimate()->text().c_str()
                         : on             ? "\u2026"
                                          : "off");
}

void shownRow(const PanelContext& ui, Requests& requests) {
  using Shown = SplitView::Shown;
  const SplitView& split = ui.session.split();
  struct Choice {
    const char *label, *widget, *help;
    std::optional<Shown> shown;  // none: off
  };
  static const std::array kChoices = {
      Choice{"Off", "off", "Only the picture.", {}},
      Choice{"A | B", "both", "Side by side, with a divider to drag.", Shown::both},
      Choice{"A", "first", "A alone; Space shows the other.", Shown::first},
      Choice{"B", "second", "B alone; Space shows the other.", Shown::second},
      Choice{"Heat", "heat", "The difference between A and B, in false colour.", Shown::heat},
      Choice{"All", "tiles",
             "All methods as tiles with the error of each. Each frame renders the picture and one "
             "tile, which makes frames longer; each method keeps a copy of the level in memory.",
             Shown::tiles},
  };
  labelledRow(ui, "Compare",
              "Compares the picture with a second one of the same view, which costs the time to "
              "render it.");
  const float gap = ui.px(3);
  // Each is as wide as its text and an equal part of what is left.
  const auto count = static_cast<float>(kChoices.size());
  float left = ImGui::GetContentRegionAvail().x - (count - 1) * gap;
  for (const Choice& choice : kChoices) left -= ImGui::CalcTextSize(choice.label).x;
  for (const Choice& choice : kChoices) {
    if (&choice != &kChoices.front()) ImGui::SameLine(0, gap);
    const bool holds = choice.shown ? split.on() && split.shown() == *choice.shown : !split.on();
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.px(2), ui.px(4)});
    const float width = std::floor(ImGui::CalcTextSize(choice.label).x + left / count);
    const bool clicked = toggleButton(choice.label, holds, {width, 0});
    ImGui::PopStyleVar();
    ui.name(std::string("show/") + choice.widget);
    tooltip(ui, choice.help);
    if (!clicked || holds) continue;
    if (choice.shown == Shown::tiles)
      requests.actions.emplace_back("split.tiles");
    else
      requests.actions.push_back(std::string("split.show ") + choice.widget);
  }
}

}  // namespace

void compareSection(const PanelContext& ui, Requests& requests) {
  if (!section(ui, "Compare", false)) return;
  errorRow(ui, requests);
  shownRow(ui, requests);
  const SplitView& split = ui.session.split();
  const std::string a = split.on() ? split.first().text : "live";
  const std::string b = split.on() ? split.second().text : kReferenceMethod;
  const auto first = sideCombo(ui, "A, left", "side_a", a);
  const auto second = sideCombo(ui, "B, right", "side_b", b);
  if (first || second) {
    const bool showsHeat = split.on() && split.shown() == SplitView::Shown::heat;
    requests.actions.push_back("split.on " + first.value_or(a) + " " + second.value_or(b));
    if (showsHeat) requests.actions.emplace_back("split.show heat");
  }
  labelledRow(ui, "Heat map to", "Difference at the end of the heat map's colour scale.");
  float percent = 100.0f * split.heatScale();
  if (valueSlider("##heat", percent, 1.0f, 200.0f, "%.3g %% of the mean",
                  ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic)) {
    char action[48];
    std::snprintf(action, sizeof action, "split.heat_scale %.5f",
                  static_cast<double>(percent) / 100.0);
    requests.actions.emplace_back(action);
  }
  ui.name("heat_scale");
}

}  // namespace lamplighter
