#include <algorithm>
#include <cstdio>
#include <vector>

// For text with an ellipsis, which imgui.h of 1.86 does not declare.
#include <imgui_internal.h>

#include "ui/panels/panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

struct Part {
  std::string widget;
  std::string text;
  unsigned colour;
  std::string help;
};
using Parts = std::vector<Part>;

constexpr float kGap = 18.0f;  // gap between two parts, in design pixels

float widthOf(const PanelContext& ui, const Parts& parts) {
  float width = 0.0f;
  for (const Part& p : parts) width += ImGui::CalcTextSize(p.text.c_str()).x + ui.px(kGap);
  return width;
}

// Hides parts until the rest fits, the least important first. The parts that are not named here
// always stay.
void fit(const PanelContext& ui, Parts& parts, float room) {
  std::vector<std::string> order{"backend", "latency"};
  const std::vector<StatusText> statistics = statusTexts(ui.session.output().stats.declared);
  for (auto s = statistics.rbegin(); s != statistics.rend(); ++s) order.push_back(s->name);
  order.insert(order.end(), {"error", "time"});
  for (const std::string& name : order) {
    if (widthOf(ui, parts) <= room) return;
    std::erase_if(parts, [&](const Part& p) { return p.widget == name; });
  }
}

unsigned colourOf(const StatusText& text) {
  if (!text.isPending) return theme::kText;
  return text.isZero ? theme::kTextDim : theme::kAccent;
}

void draw(const PanelContext& ui, const Part& p) {
  colouredText(p.text, p.colour);
  ui.name(p.widget);
  tooltip(ui, p.help);
  ImGui::SameLine(0, ui.px(kGap));
}

std::string frameTime(double seconds) {
  char text[48];
  std::snprintf(text, sizeof text, "%.1f ms  %.0f fps", seconds * 1e3,
                seconds > 0.0 ? 1.0 / seconds : 0.0);
  return text;
}

std::string errorHelp(const ErrorMeter& meter) {
  const std::string blocks = std::to_string(meter.block());
  std::string help =
      "Error of the picture against the path-traced reference: the root mean square of the "
      "difference of blocks of " +
      blocks + " x " + blocks +
      " pixels, relative to the mean; blocks that show a lamp itself are left out. The noise of "
      "the reference is subtracted; the remaining uncertainty follows the \u00b1 (one standard "
      "deviation).";
  if (meter.estimate())
    help += " " + grouped(meter.estimate()->samples) + " paths per block so far.";
  return help;
}

// "edit 95% in 7 frames, 120 ms"
std::string latencyShort(const LatencyResult& result) {
  if (!result.visible) return "edit not seen";
  char text[64];
  std::snprintf(text, sizeof text, "edit 95%% in %.0f ms, %d frame%s",
                result.within[1].milliseconds, result.within[1].frames,
                result.within[1].frames == 1 ? "" : "s");
  return text;
}

std::string frames(int count) { return grouped(count) + (count == 1 ? " frame" : " frames"); }

// All parts that describe the picture, in display order.
Parts partsOf(const PanelContext& ui, const StatusInfo& info) {
  Parts parts;
  const GiOutput& output = ui.session.output();
  const GiStats& stats = output.stats;
  if (output.settled && !output.refined) {
    parts.push_back({"settled", withIcon(icon::kSettled, "refining"), theme::kGood,
                     "All updates are done. Until the next edit, paths of the reference or more "
                     "light samples improve the picture."});
  } else if (output.settled) {
    parts.push_back({"settled", withIcon(icon::kSettled, "settled"), theme::kGood,
                     "All updates are done; more frames would not change the picture."});
  } else {
    const std::string text = stats.framesUntilSettled > 0
                                 ? "settled in " + frames(stats.framesUntilSettled)
                                 : "updating";
    parts.push_back({"settled", withIcon(icon::kUpdating, text), theme::kAccent,
                     "Estimated frames until all updates are done, antialiasing included."});
  }
  parts.push_back({"time", frameTime(info.frameSeconds), theme::kText,
                   "Time per frame, averaged over the last frames."});
  for (const StatusText& text : statusTexts(stats.declared))
    parts.push_back({text.name, text.text, colourOf(text), text.meaning});
  const FrameWatch& watch = ui.session.watch();
  if (const std::string error = watch.meter.text(); !error.empty())
    parts.push_back(
        {"error", error,
         watch.meter.estimate() && watch.meter.estimate()->isKnown ? theme::kText : theme::kTextDim,
         errorHelp(watch.meter)});
  if (!watch.latency.results().empty())
    parts.push_back(
        {"latency", latencyShort(watch.latency.results().back()), theme::kText,
         "Time until the last edit was visible: " + watch.latency.results().back().what + ": " +
             latencyText(watch.latency.results().back(), true) +
             ". The percentages are progress from the picture before the edit to the settled "
             "picture."});
  const BackendInfo& backend = ui.session.renderer().backend().info();
  parts.push_back({"backend", backend.name, theme::kTextDim, backend.name + ": " + backend.device});
  if (info.recording)
    parts.push_back({"recording", "recording", 0xe06a5a, "Input is being recorded."});
  if (info.replaying)
    parts.push_back({"replaying", "replaying", theme::kAccent, "Input is from a recording."});

  const ViewDisplay& display = ui.session.display();
  if (const std::string view = display.viewText(); !view.empty()) {
    const bool isProblem = display.picture() && !display.picture()->problem.empty();
    parts.push_back(
        {"view", view, isProblem ? theme::kWarning : theme::kText, infoOf(display.view()).help});
  }
  const std::string vpl =
      display.vplText(ui.session.document().scene, ui.session.inspect(), ui.session.unit());
  if (!vpl.empty()) parts.push_back({"vpl", vpl, theme::kText, "The chosen light sample."});

  if (const std::string probes = ui.session.probes().text(ui.session.unit()); !probes.empty())
    parts.push_back({"probes", probes, theme::kText,
                     "Number of valid light probes, and the progress of computing their light."});
  if (const auto& reading = ui.session.points().reading();
      reading && ui.session.points().probesPointer())
    parts.push_back({"probe", readingText(*reading), theme::kText,
                     "At the pointer: the illuminance of the surface (lx), and the luminance that "
                     "reaches the camera (nt = cd/m\u00b2)."});
  return parts;
}

}  // namespace

void statusLine(PanelContext ui, const StatusInfo& info) {
  ui.prefix = "status/";
  ImGui::AlignTextToFramePadding();
  const std::string& status = ui.session.status();
  Parts parts = partsOf(ui, info);
  // A message gets a third of the line, or less if it is shorter.
  const float whole = ImGui::GetContentRegionAvail().x;
  fit(ui, parts, whole - std::min(ImGui::CalcTextSize(status.c_str()).x, whole / 3.0f));
  for (const Part& p : parts) draw(ui, p);

  // The message is at the end, so that the parts before it do not move.
  if (status.empty()) return;
  const float room = ImGui::GetContentRegionAvail().x;
  const float width = ImGui::CalcTextSize(status.c_str()).x;
  if (width < room) ImGui::SetCursorPosX(ImGui::GetCursorPosX() + room - width);
  ImVec2 at = ImGui::GetCursorScreenPos();
  at.y += ImGui::GetStyle().FramePadding.y;  // aligned with the parts
  const ImVec2 end{at.x + std::min(width, room), at.y + ImGui::GetTextLineHeight()};
  ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), at, end, end.x, end.x, status.c_str(),
                            status.c_str() + status.size(), nullptr);
  ImGui::Dummy({end.x - at.x, end.y - at.y});
  ui.name("message");
  tooltip(ui, status);
}

}  // namespace lamplighter
