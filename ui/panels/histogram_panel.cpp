#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "editor/explain/quantity.h"
#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr float kHistogramWidth = 330.0f, kLeastHistogramWidth = 280.0f, kBarsHeight = 92.0f,
                kLeastBarsHeight = 30.0f;  // height of the bars in design pixels

float atStops(const Rect& area, float stops) {
  const float t = (stops - Histogram::kLowest) / (Histogram::kHighest - Histogram::kLowest);
  return area.min.x + t * area.size().x;
}

// Draws the bars, with lines at 1 and at middle grey and a tick per stop.
void bars(const PanelContext& ui, const Histogram& h, float height) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::GetContentRegionAvail().x;
  ImGui::InvisibleButton("bars", {width, height});
  ui.name("bars");
  const Rect area{{at.x, at.y}, {at.x + width, at.y + height}};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {area.max.x, area.max.y}, theme::colour(theme::kBackground), ui.px(3));
  // The first and last bins also count all values beyond. They must not scale down the other bars.
  const uint64_t most =
      std::max<uint64_t>(*std::max_element(h.bins.begin() + 1, h.bins.end() - 1), 1);
  const float step = width / Histogram::kBins;
  for (int i = 0; i < Histogram::kBins; ++i) {
    const auto count = static_cast<float>(h.bins[static_cast<size_t>(i)]);
    if (count == 0.0f) continue;
    // The square root makes rare brightnesses visible.
    const float share = std::min(std::sqrt(count / static_cast<float>(most)), 1.0f);
    const float x = area.min.x + step * static_cast<float>(i);
    const float top = area.max.y - std::max(share * (height - ui.px(4)), 1.0f);
    const float stops = Histogram::kLowest + (Histogram::kHighest - Histogram::kLowest) *
                                                 (static_cast<float>(i) + 0.5f) / Histogram::kBins;
    list.AddRectFilled({x, top}, {x + step, area.max.y},
                       theme::colour(stops >= 0.0f ? theme::kWarning : theme::kTextDim, 220));
  }
  for (const auto& [stops, colour] : {std::pair{0.0f, theme::kText}, {-2.474f, theme::kAccent}}) {
    const float x = std::round(atStops(area, stops));
    list.AddLine({x, area.min.y}, {x, area.max.y}, theme::colour(colour, 150));
  }
  for (float stops = Histogram::kLowest; stops <= Histogram::kHighest; stops += 1.0f) {
    const float x = std::round(atStops(area, stops));
    list.AddLine({x, area.max.y - ui.px(4)}, {x, area.max.y}, theme::colour(theme::kLine));
  }
  const float stops = Histogram::kLowest + (Histogram::kHighest - Histogram::kLowest) *
                                               (ImGui::GetMousePos().x - area.min.x) / width;
  const float ev = ui.session.document().render.exposureEv;
  tooltip(ui, fmt::format("{:+.1f} stops: {}. The white line is display white of a linear curve, "
                          "the amber line is middle grey (0.18).",
                          stops, nitsText(std::exp2(stops - ev))));
}

void exposureField(const PanelContext& ui, Requests& requests) {
  labelledRow(ui, "Exposure",
              "Exposure in EV: each step of 1 doubles the brightness of the picture. The lighting "
              "does not change.");
  const float button = ui.px(56), gap = ui.px(5);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - button - gap);
  float ev = ui.session.document().render.exposureEv;
  ImGui::InputFloat("##exposure", &ev, 0.25f, 1.0f, "%+.2f EV");
  ui.name("exposure");
  if (ImGui::IsItemDeactivatedAfterEdit() && std::isfinite(ev))
    requests.actions.push_back(fmt::format("render.exposure {}", ev));
  ImGui::SameLine(0, gap);
  if (ImGui::Button("Auto", {button, 0})) requests.actions.emplace_back("render.auto_exposure");
  ui.name("auto");
  tooltip(ui, "Sets the exposure so that the log-average luminance of the picture is middle grey.");
}

void mapperCombo(const PanelContext& ui, Requests& requests) {
  const ToneMapperInfo& now = infoOf(ui.session.display().toneMapper());
  labelledRow(ui, "Tone mapper", now.help);
  std::vector<ComboItem> items;
  for (const ToneMapperInfo& m : toneMappers()) items.push_back({m.name, m.label, m.help});
  const int chosen =
      combo(ui, "tone_mapper", now.label, items, static_cast<int>(&now - toneMappers().data()));
  if (chosen != kNone)
    requests.actions.push_back("view.tone_mapper " + items[static_cast<size_t>(chosen)].name);
}

}  // namespace

Rect histogramPanel(PanelContext ui, const Rect& view, Requests& requests) {
  Session& session = ui.session;
  if (!session.display().showsHistogram() || !session.output().radiance) return {};
  ui.prefix = "histogram/";
  const float gap = ui.px(10);
  const float width = std::max(std::min(ui.px(kHistogramWidth), view.size().x - 2.0f * gap),
                               ui.px(kLeastHistogramWidth));
  ImGui::SetNextWindowPos({view.max.x - gap, view.max.y - gap}, ImGuiCond_Always, {1.0f, 1.0f});
  ImGui::SetNextWindowSize({width, 0.0f});
  beginOverlay(ui, "##histogram");
  const Histogram& h =
      session.display().histogram(session.output().radiance, session.document().render.exposureEv);
  // If space is short, first the fields are hidden, because the render panel and the menu also have
  // them. Then the height shrinks.
  const ImGuiStyle& style = ImGui::GetStyle();
  const float room = view.size().y - 2.0f * gap - 2.0f * style.WindowPadding.y -
                     ImGui::GetTextLineHeight() - style.ItemSpacing.y;
  const bool hasFields = room >= ui.px(kBarsHeight) + 2.0f * ImGui::GetFrameHeightWithSpacing();
  bars(ui, h, std::clamp(room, ui.px(kLeastBarsHeight), ui.px(kBarsHeight)));
  note(fmt::format("{} white   {} black   median {}", percentText(h.white), percentText(h.black),
                   nitsText(h.median)));
  ui.name("clipped");
  if (hasFields) {
    exposureField(ui, requests);
    mapperCombo(ui, requests);
  }
  const Rect covered = windowRect();
  ImGui::End();
  return covered;
}

}  // namespace lamplighter
