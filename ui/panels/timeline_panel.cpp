// The time spent by the frames of the last seconds: bars of stages, a legend, and counters.
#include <algorithm>
#include <cmath>
#include <cstdio>

#include "renderer/methods/common_parameters.h"
#include "renderer/registry/registry.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

// Colours of the stages of a method, in their order. Neighbours differ in hue and in lightness.
constexpr unsigned kStageColours[] = {0xd9b44a, 0x4f80c8, 0x9fc25b, 0x376c8a, 0xa0558a,
                                      0x5fb6a6, 0x8d8f98, 0xe2793f, 0x3f6b59, 0xc7a3d8,
                                      0xb5534c, 0x7fb7e6, 0xd58bbb};
constexpr unsigned kOtherColour = 0x4a4e57;

// Shorter stages are not listed [s]: they would read 0.0 ms.
constexpr double kSeen = 5e-5;

// `index`: of the stage in the list of its method.
unsigned colourOf(const StageSpec& stage, size_t index) {
  return stage == kOtherStage ? kOtherColour : kStageColours[index % std::size(kStageColours)];
}

std::string milliseconds(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, seconds < 0.0995 ? "%.1f ms" : "%.0f ms", 1e3 * seconds);
  return text;
}

// The time at the upper edge of the graph [s]. All but the longest frames and the budget fit.
double rangeOf(const Timeline& timeline, size_t bars, double budget) {
  std::vector<double> lengths;
  const auto& frames = timeline.frames();
  for (size_t i = frames.size() - std::min(bars, frames.size()); i < frames.size(); ++i)
    lengths.push_back(frames[i].seconds());
  if (lengths.empty()) return std::max(budget, 0.01);
  std::sort(lengths.begin(), lengths.end());
  const double most = std::max(lengths[(lengths.size() - 1) * 95 / 100], 1.1 * budget);
  // 1, 2 or 5 times a power of ten.
  const double unit = std::pow(10.0, std::floor(std::log10(std::max(most, 1e-4))));
  for (const double step : {1.0, 2.0, 5.0, 10.0})
    if (step * unit >= most) return step * unit;
  return most;
}

void stageTooltip(const PanelContext& ui, const FrameTiming& frame, size_t hovered) {
  ImGui::BeginTooltip();
  ImGui::Text("frame %u: %s", frame.frame, milliseconds(frame.seconds()).c_str());
  for (size_t i = 0; i < frame.stats.stageSeconds.size(); ++i) {
    const auto& [stage, seconds] = frame.stats.stageSeconds[i];
    if (seconds < kSeen) continue;
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + ui.px(2)},
                                              {at.x + side - ui.px(4), at.y + side - ui.px(2)},
                                              theme::colour(colourOf(stage, i)), ui.px(2));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side);
    const unsigned colour = i == hovered ? theme::kAccent : theme::kText;
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(colour));
    ImGui::TextUnformatted((std::string(stage.label) + "  " + milliseconds(seconds)).c_str());
    ImGui::PopStyleColor();
  }
  ImGui::EndTooltip();
}

struct Graph {
  ImVec2 low, high;
  float bar = 3.0f;
  double range = 0.1;
  float yOf(double seconds) const {
    return high.y - static_cast<float>(std::min(seconds / range, 1.0)) * (high.y - low.y);
  }
};

// Draws the bars with the newest frame at the right edge.
void drawBars(const PanelContext& ui, const Timeline& timeline, const Graph& graph, bool hovered) {
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const float gap = ui.px(1);
  float right = graph.high.x;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  for (auto frame = timeline.frames().rbegin();
       frame != timeline.frames().rend() && right - graph.bar >= graph.low.x; ++frame) {
    const float left = right - graph.bar;
    const bool isUnder = hovered && mouse.x >= left && mouse.x < right;
    double below = 0.0;
    const std::vector<StageTime>& times = frame->stats.stageSeconds;
    size_t under = times.size();
    for (size_t i = 0; i < times.size(); ++i) {
      const auto& [stage, seconds] = times[i];
      if (seconds <= 0.0) continue;
      const float bottom = graph.yOf(below), top = graph.yOf(below + seconds);
      list.AddRectFilled({left, top}, {right - gap, bottom}, theme::colour(colourOf(stage, i)));
      if (isUnder && mouse.y >= top && mouse.y < bottom) under = i;
      below += seconds;
    }
    if (isUnder) {
      list.AddRect({left - gap, graph.yOf(below) - gap}, {right, graph.high.y},
                   theme::colour(theme::kText));
      stageTooltip(ui, *frame, under);
    }
    right = left;
  }
}

// Draws a label over the bars, on a translucent background.
void label(const PanelContext& ui, ImDrawList& list, const ImVec2& at, unsigned colour,
           const std::string& text) {
  const ImVec2 size = ImGui::CalcTextSize(text.c_str());
  const float pad = ui.px(2);
  list.AddRectFilled(at, {at.x + size.x + 2 * pad, at.y + size.y},
                     theme::colour(theme::kBackground, 190), pad);
  list.AddText({at.x + pad, at.y}, theme::colour(colour), text.c_str());
}

void drawGraph(const PanelContext& ui, TimelineState& state) {
  const Timeline& live = ui.session.watch().timeline;
  const float width = std::max(ImGui::GetContentRegionAvail().x, ui.px(60));
  Graph graph;
  graph.low = ImGui::GetCursorScreenPos();
  graph.high = {graph.low.x + width, graph.low.y + ui.px(96)};
  graph.bar = ui.px(4);
  ImGui::InvisibleButton("##timeline", {width, ui.px(96)});
  ui.name("timeline");
  // Moving bars would be hard to point at, so they stop while the pointer is over them.
  const bool hovered = ImGui::IsItemHovered();
  if (hovered && !state.held) state.held = live;
  if (!hovered) state.held.reset();
  const Timeline& timeline = state.held ? *state.held : live;

  const auto& settings = ui.session.document().render.values;
  const double budget = 1e-3 * frameBudgetParameters().read(settings).frameTime;
  graph.range = rangeOf(timeline, static_cast<size_t>(width / graph.bar), budget);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(graph.low, graph.high, theme::colour(theme::kBackground), ui.px(3));
  list.PushClipRect(graph.low, graph.high, true);
  drawBars(ui, timeline, graph, hovered);
  if (budget > 0.0 && budget <= graph.range) {
    const float y = graph.yOf(budget);
    list.AddLine({graph.low.x, y}, {graph.high.x, y}, theme::colour(theme::kAccent, 160), ui.px(1));
    label(ui, list, {graph.low.x + ui.px(3), y + ui.px(2)}, theme::kAccent,
          "budget " + milliseconds(budget));
  }
  label(ui, list, {graph.low.x + ui.px(3), graph.low.y + ui.px(1)}, theme::kTextDim,
        milliseconds(graph.range));
  list.PopClipRect();
}

// A square and a label for each stage of the method with its mean time, in two columns. Stages that
// took no time are dimmed and not removed, so that the items below do not move.
void drawLegend(const PanelContext& ui) {
  const Timeline& timeline = ui.session.watch().timeline;
  if (!ImGui::BeginTable("##stages", 2, ImGuiTableFlags_SizingStretchSame)) return;
  const auto declared = findMethod(ui.session.document().render.method).stages;
  std::vector<StageSpec> stages(declared.begin(), declared.end());
  stages.push_back(kOtherStage);
  for (size_t i = 0; i < stages.size(); ++i) {
    const StageSpec& stage = stages[i];
    const double mean = timeline.meanOf(stage);
    ImGui::TableNextColumn();
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled({at.x, at.y + ui.px(3)},
                                              {at.x + side - ui.px(6), at.y + side - ui.px(3)},
                                              theme::colour(colourOf(stage, i)), ui.px(2));
    ImGui::SetCursorPosX(ImGui::GetCursorPosX() + side);
    const bool took = mean >= kSeen;
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(took ? theme::kText : theme::kTextDim));
    ImGui::TextUnformatted(
        (std::string(stage.label) + (took ? "  " + milliseconds(mean) : "")).c_str());
    ImGui::PopStyleColor();
    tooltip(ui, std::string(stage.meaning) +
                    " Mean over the frames with this stage: " + milliseconds(mean) + ".");
  }
  ImGui::EndTable();
}

void drawCounters(const PanelContext& ui) {
  const auto& frames = ui.session.watch().timeline.frames();
  const GiStats& now = ui.session.output().stats;
  if (!ImGui::BeginTable("##counters", 3, ImGuiTableFlags_SizingStretchProp)) return;
  ImGui::TableNextColumn();
  colouredText("Counts", theme::kTextDim);
  for (const char* heading : {"this frame", "most in one"}) {
    ImGui::TableNextColumn();
    rightAligned(heading, theme::kTextDim);
  }
  for (const StatisticSpec& spec : findMethod(ui.session.document().render.method).statistics) {
    if (!spec.inTimeline) continue;
    const double count = now.find(spec.name).value_or(0.0);
    double most = count;
    for (const FrameTiming& f : frames)
      most = std::max(most, f.stats.find(spec.name).value_or(0.0));
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(spec.label.c_str());
    tooltip(ui, spec.meaning);
    ImGui::TableNextColumn();
    rightAligned(valueText(spec, count), theme::kText);
    ImGui::TableNextColumn();
    rightAligned(valueText(spec, most), theme::kText);
  }
  ImGui::EndTable();
}

}  // namespace

void timelineSection(const PanelContext& ui, TimelineState& state, Requests& requests) {
  if (!section(ui, "Timeline", false)) return;
  drawGraph(ui, state);
  drawLegend(ui);
  if (ImGui::Button("Export\u2026")) requests.actions.emplace_back("timeline.export");
  ui.name("export");
  tooltip(ui,
          "Writes the frames of the last seconds: .json for chrome://tracing and Perfetto, .csv "
          "for a table.");
  ImGui::SameLine();
  if (ImGui::Button("Clear")) requests.actions.emplace_back("timeline.clear");
  ui.name("clear");
  drawCounters(ui);
}

}  // namespace lamplighter
