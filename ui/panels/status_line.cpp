#include <algorithm>
#include <cstdio>

#include "ui/icons.h"
#include "ui/panels/panels.h"
#include "ui/theme.h"

namespace lamplighter {
namespace {

void part(const PanelContext& ui, const char* widget, const std::string& text, unsigned colour,
          const std::string& help) {
  ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(colour));
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopStyleColor();
  ui.name(widget);
  tooltip(ui, help);
  ImGui::SameLine(0, ui.px(18));
}

std::string frameTime(double seconds) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f ms  %.0f fps", seconds * 1e3,
                seconds > 0.0 ? 1.0 / seconds : 0.0);
  return text;
}

}  // namespace

void statusLine(PanelContext ui, const StatusInfo& info) {
  ui.prefix = "status/";
  const GiOutput& output = ui.session.output();
  const GiStats& stats = output.stats;
  ImGui::AlignTextToFramePadding();
  if (output.settled)
    part(ui, "settled", withIcon(icon::kSettled, "settled"), theme::kGood,
         "The picture is what the scene asks for; another frame would change nothing.");
  else
    part(ui, "settled", withIcon(icon::kUpdating, "updating"), theme::kAccent,
         "Some of the light samples are still from before the last change.");
  part(ui, "time", frameTime(info.frameSeconds), theme::kText,
       "Time a frame, averaged over the last ones.");
  if (stats.vpls > 0) {
    part(ui, "vpls", grouped(stats.vpls) + " VPLs", theme::kText,
         "Light samples (virtual point lights) that light the picture.");
    std::string pending = grouped(stats.mapsPending) + " maps pending";
    if (stats.vplsPending > 0)
      pending += ", oldest " + std::to_string(stats.oldestFrames) +
                 (stats.oldestFrames == 1 ? " frame" : " frames");
    part(ui, "pending", pending, stats.vplsPending > 0 ? theme::kAccent : theme::kTextDim,
         "Shadow maps that wait to be rendered anew, and for how long the oldest has waited.");
  }
  if (stats.samplesPerPixel > 1)
    part(ui, "samples", grouped(stats.samplesPerPixel) + " samples a pixel", theme::kText,
         "Paths traced for each pixel so far.");
  const BackendInfo& backend = ui.session.renderer().backend().info();
  part(ui, "backend", backend.name, theme::kTextDim, backend.name + ": " + backend.device);
  if (info.recording) part(ui, "recording", "recording", 0xe06a5a, "Input is being recorded.");
  if (info.replaying)
    part(ui, "replaying", "replaying", theme::kAccent, "Input is from a recording.");

  // What there is to tell stands at the end, so that what stands before does not move.
  const std::string& status = ui.session.status();
  if (status.empty()) return;
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = ImGui::CalcTextSize(status.c_str()).x;
  if (width < room) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  ImGui::PushClipRect(at, {at.x + room, at.y + ImGui::GetFrameHeight()}, true);
  ImGui::TextUnformatted(status.c_str());
  ImGui::PopClipRect();
  ui.name("message");
  tooltip(ui, status);
}

}  // namespace lamplighter
