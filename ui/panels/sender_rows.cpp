// Where the bounced light of the explained point comes from, with a row for each surface.
#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "editor/explain/quantity.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr const char* kSenderColumns[] = {"", "Surface", "Material", "lx", "Share", ""};

void swatch(const PanelContext& ui, const LightSender& sender) {
  const vec3 c = linearToSrgb(sender.colour);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetTextLineHeight() - ui.px(4);
  ImGui::GetWindowDrawList()->AddRectFilled(
      {at.x, at.y + ui.px(2)}, {at.x + side, at.y + ui.px(2) + side},
      ImGui::ColorConvertFloat4ToU32({c.r, c.g, c.b, 1.0f}), ui.px(2));
}

// `widget`: "senders" or "sender.3"; `action`: of a click.
void senderRow(const PanelContext& ui, const LightSenders& senders, const LightSender& sender,
               const std::string& widget, const std::string& action, bool isChosen,
               Requests& requests) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::PushID(widget.c_str());
  swatch(ui, sender);
  ImGui::TableNextColumn();
  if (ImGui::Selectable(
          sender.name.c_str(), isChosen,
          ImGuiSelectableFlags_SpanAllColumns | ImGuiSelectableFlags_AllowItemOverlap))
    requests.actions.push_back(action);
  ui.name(widget);
  tooltip(ui,
          fmt::format(
              "{}{}{}: contributes {} to the point, {} of its bounced light. Click to draw lines "
              "to the places that reflect this light, in its colour. Brighter lines: more light.",
              sender.name, sender.material.empty() ? "" : ", ", sender.material,
              luxText(sender.irradiance), percentText(senders.shareOf(sender))));
  ImGui::TableNextColumn();
  colouredText(sender.material, theme::kTextDim);
  ImGui::TableNextColumn();
  rightAligned(threeDigits(sender.irradiance), theme::kText);
  ImGui::TableNextColumn();
  rightAligned(percentText(senders.shareOf(sender)), theme::kText);
  ImGui::TableNextColumn();
  if (sender.key.node != kNoNode) {
    if (ImGui::SmallButton("select"))
      requests.actions.push_back("explain.sender_object " + widget.substr(widget.find('.') + 1));
    ui.name(widget + "/select");
    tooltip(ui, "Selects " + sender.name + ", so that its material can be changed.");
  }
  ImGui::PopID();
}

void senderColumns(const PanelContext& ui) {
  const float widths[] = {14, 1.25f, 1.0f, 58, 44, 50};
  for (size_t i = 0; i < std::size(kSenderColumns); ++i) {
    const bool isText = i == 1 || i == 2;
    ImGui::TableSetupColumn(
        fmt::format("{}##{}", kSenderColumns[i], i).c_str(),
        isText ? ImGuiTableColumnFlags_WidthStretch : ImGuiTableColumnFlags_WidthFixed,
        isText ? widths[i] : ui.px(widths[i]));
  }
  ImGui::TableSetupScrollFreeze(0, 1);
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(theme::kTextDim));
  ImGui::TableHeadersRow();
  ImGui::PopStyleColor();
}

}  // namespace

void senderRows(const PanelContext& ui, float mostRows, Requests& requests) {
  const Explainer& explainer = ui.session.points().explainer();
  const LightSenders& senders = explainer.senders();
  ImGui::Dummy({0.0f, ui.px(4)});
  ImGui::TextUnformatted("Bounced light comes from");
  if (!senders.problem.empty()) {
    note("Not known: " + senders.problem + ". To see it, " + senders.remedy + ".");
    ui.name("senders.problem");
    return;
  }
  ImGui::SameLine(0, ui.px(14));
  colouredText(luxText(senders.irradiance), theme::kAccent);
  ui.name("bounced");
  tooltip(ui,
          "Bounced illuminance of the surface, as the method stores it on the surface. The values "
          "of the lights above are from light samples, so sums may differ slightly.");
  if (senders.rows.empty()) {
    note("No surface reflects light to this point.");
    return;
  }
  const float rows = std::min(static_cast<float>(senders.rows.size()) + 1.0f, mostRows);
  if (!ImGui::BeginTable(
          "senders", static_cast<int>(std::size(kSenderColumns)),
          ImGuiTableFlags_ScrollY | ImGuiTableFlags_RowBg | ImGuiTableFlags_BordersInnerH,
          {0.0f, heightOfRows(ui, rows + 1.0f)}))
    return;
  senderColumns(ui);
  const LightSender* chosen = explainer.chosenSender();
  senderRow(ui, senders, senders.all, "senders", "explain.senders", chosen == &senders.all,
            requests);
  for (size_t row = 0; row < senders.rows.size(); ++row)
    senderRow(ui, senders, senders.rows[row], fmt::format("sender.{}", row),
              fmt::format("explain.sender {}", row), chosen == &senders.rows[row], requests);
  ImGui::EndTable();
}

}  // namespace lamplighter
