// Shows the explanation of "why is it dark here?" with a row for each light.
#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "editor/explain/quantity.h"
#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr float kExplainWidth = 540.0f, kLeastExplainWidth = 430.0f;  // design pixels
// Rows of a table without scrolling, and the part of the view that the tables may cover: lines are
// drawn in the view.
constexpr float kLeastRows = 4.0f, kMostRows = 9.0f, kShareOfHeight = 0.4f;

unsigned colourOf(LightArrival state) {
  switch (state) {
    case LightArrival::lit:
      return theme::kGood;
    case LightArrival::partly:
      return theme::kWarning;
    case LightArrival::shadowed:
      return 0xe06a5a;
    default:
      return theme::kTextDim;
  }
}

std::string stateText(const LightShare& l) {
  const std::string name = nameOf(l.state);
  return l.state == LightArrival::partly ? fmt::format("{} {}/{}", name, l.seen, l.facing) : name;
}

std::string stateHelp(const LightShare& l) {
  switch (l.state) {
    case LightArrival::off:
      return "The light is hidden, or its strength is 0.";
    case LightArrival::unsampled:
      return "All light samples are used by brighter lights. With more light samples, this light "
             "gets some, too.";
    case LightArrival::away:
      return "The surface faces away from the light, or is behind it or outside its cone.";
    default:
      break;
  }
  std::string text =
      fmt::format("{} of the {} light samples that face the point reach it.", l.seen, l.facing);
  if (l.withheld > 0.0f) text += fmt::format(" {} are blocked.", luxText(l.withheld));
  if (l.bouncedFacing > 0)
    text += fmt::format(" Of its bounced light samples, {} of {} reach it.", l.bouncedSeen,
                        l.bouncedFacing);
  return text;
}

void header(const PanelContext& ui, const Explanation& e, Requests& requests) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Why is it dark here?");
  const float width = ImGui::GetFrameHeight();
  ImGui::SameLine(ImGui::GetWindowContentRegionMax().x - width);
  if (ImGui::Button(theme::hasIcons() ? icon::kClose : "x", {width, 0}))
    requests.actions.emplace_back("explain.close");
  ui.name("close");
  tooltip(ui, "Close");
  const vec3& p = e.point.position;
  colouredText(fmt::format("{}  at {:.2f}, {:.2f}, {:.2f}", e.object, p.x, p.y, p.z),
               theme::kTextDim);
  ImGui::SameLine(0, ui.px(14));
  colouredText(luxText(e.irradiance), theme::kAccent);
  ui.name("irradiance");
  tooltip(ui, "Illuminance of the surface by all lights and bounces together.");
}

void blockers(const PanelContext& ui, const LightShare& l, int row, Requests& requests) {
  // The first blocker; the tooltip lists the others.
  const BlockingObject& first = l.blockers.front();
  std::string label = first.name;
  if (l.blockers.size() > 1) label += fmt::format(" +{}", l.blockers.size() - 1);
  if (ImGui::SmallButton((label + "##blocker").c_str()))
    requests.actions.push_back(fmt::format("explain.blocker {} 0", row));
  ui.name(fmt::format("row.{}/blocker", row));
  std::string help = "Blocks the light. Click to select it.";
  for (const BlockingObject& b : l.blockers)
    help += fmt::format("\n{}: {}, {} sample{}", b.name, luxText(b.withheld), b.samples,
                        b.samples == 1 ? "" : "s");
  tooltip(ui, help);
}

void lightRow(const PanelContext& ui, const Explanation& e, int row, bool chosen,
              Requests& requests) {
  const LightShare& l = e.lights[static_cast<size_t>(row)];
  const bool gives = l.given() > 0.0f;
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(row);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(gives ? theme::kText : theme::kTextDim));
  if (ImGui::Selectable(
          l.name.c_str(), chosen,
          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
    requests.actions.push_back("explain.light " + std::to_string(row));
  ImGui::PopStyleColor();
  ui.name("row." + std::to_string(row));
  tooltip(ui, l.name + ": " + stateHelp(l));
  ImGui::TableNextColumn();
  colouredText(stateText(l), colourOf(l.state));
  ImGui::TableNextColumn();
  rightAligned(l.direct > 0.0f ? threeDigits(l.direct) : "\u2013",
               gives ? theme::kText : theme::kTextDim);
  ImGui::TableNextColumn();
  rightAligned(l.bounced > 0.0f ? threeDigits(l.bounced) : "\u2013",
               gives ? theme::kText : theme::kTextDim);
  ImGui::TableNextColumn();
  rightAligned(percentText(e.shareOf(l)), gives ? theme::kText : theme::kTextDim);
  ImGui::TableNextColumn();
  if (!l.blockers.empty()) blockers(ui, l, row, requests);
  ImGui::PopID();
}

void columns(const PanelContext& ui) {
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::TableSetupColumn("Light", ImGuiTableColumnFlags_WidthStretch, 1.25f);
  ImGui::TableSetupColumn("State", ImGuiTableColumnFlags_WidthFixed, ui.px(94));
  ImGui::TableSetupColumn("Direct lx", ImGuiTableColumnFlags_WidthFixed, ui.px(58));
  ImGui::TableSetupColumn("Bounced lx", ImGuiTableColumnFlags_WidthFixed, ui.px(72));
  ImGui::TableSetupColumn("Share", ImGuiTableColumnFlags_WidthFixed, ui.px(40));
  ImGui::TableSetupColumn("Kept away by", ImGuiTableColumnFlags_WidthStretch, 1.0f);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
}

}  // namespace

Rect explainPanel(PanelContext ui, const Rect& view, Requests& requests) {
  const Explanation* answer = ui.session.points().explainer().answer();
  if (answer == nullptr) return {};
  ui.prefix = "explain/";
  const float gap = ui.px(10);
  // If the view is very narrow, covers the neighbouring panels rather than cutting off columns.
  const float width = std::max(std::min(ui.px(kExplainWidth), view.size().x - 2.0f * gap),
                               ui.px(kLeastExplainWidth));
  const float room = std::floor(kShareOfHeight * view.size().y / heightOfRows(ui, 1.0f));
  const float rows = std::min(static_cast<float>(answer->lights.size()),
                              std::clamp(std::floor(0.5f * room), kLeastRows, kMostRows));
  const float tableHeight = heightOfRows(ui, rows + 1.0f);
  ImGui::SetNextWindowPos({std::max(view.max.x - gap - width, 0.0f), view.min.y + gap});
  ImGui::SetNextWindowSize({width, 0.0f});
  beginOverlay(ui, "##explain");
  header(ui, *answer, requests);
  if (answer->lights.empty()) {
    note("The level has no light.");
  } else if (ImGui::BeginTable(
                 "lights", 6,
                 ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH,
                 {0.0f, tableHeight})) {
    columns(ui);
    const LightShare* chosen = ui.session.points().explainer().chosen();
    for (int row = 0; row < static_cast<int>(answer->lights.size()); ++row)
      lightRow(ui, *answer, row, chosen == &answer->lights[static_cast<size_t>(row)], requests);
    ImGui::EndTable();
  }
  senderRows(ui, std::clamp(room - rows, kLeastRows, kMostRows), requests);
  const Rect covered = windowRect();
  ImGui::End();
  return covered;
}

}  // namespace lamplighter
