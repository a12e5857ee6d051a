#include <algorithm>

#include <spdlog/fmt/fmt.h>

#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr float kHistoryWidth = 240.0f, kRows = 12.0f;  // design pixels; maximum number of lines

// Row 0 is the opened level, or the oldest state that undo can reach.
std::string textOf(const History& history, size_t step) {
  if (step == 0) return "As opened";
  if (step == history.first()) return fmt::format("{}  earlier steps are forgotten", step);
  return fmt::format("{}  {}", step, history.label(step));
}

}  // namespace

Rect historyPanel(PanelContext ui, const Rect& view, Requests& requests) {
  const History& history = ui.session.history();
  if (!ui.session.display().showsHistory()) return {};
  ui.prefix = "history/";
  const float gap = ui.px(10);
  const ImGuiStyle& style = ImGui::GetStyle();
  const float row = ImGui::GetTextLineHeightWithSpacing();
  const auto count = static_cast<float>(history.last() - history.first() + 1);
  const float rest = 2.0f * row + 2.0f * style.WindowPadding.y + ui.px(4);
  const float height =
      std::min(std::min(count, kRows) * row + rest, std::max(view.size().y - 2.0f * gap, row));
  ImGui::SetNextWindowPos({view.min.x + gap, view.max.y - gap}, ImGuiCond_Always, {0.0f, 1.0f});
  ImGui::SetNextWindowSize({std::min(ui.px(kHistoryWidth), view.size().x - 2.0f * gap), height});
  beginOverlay(ui, "##history");
  ImGui::TextUnformatted("History");
  ImGui::BeginChild("##steps", {0, -row});
  const size_t now = history.position();
  // Only the visible rows: there may be a hundred thousand.
  ImGuiListClipper clipper;
  clipper.Begin(static_cast<int>(count), row);
  while (clipper.Step()) {
    for (int i = clipper.DisplayStart; i < clipper.DisplayEnd; ++i) {
      const size_t step = history.first() + static_cast<size_t>(i);
      // Undone steps are dimmed.
      ImGui::PushStyleColor(
          ImGuiCol_Text, step > now ? theme::colour(theme::kTextDim) : theme::colour(theme::kText));
      if (ImGui::Selectable((textOf(history, step) + "###" + std::to_string(step)).c_str(),
                            step == now))
        requests.actions.push_back("history.go " + std::to_string(step));
      ImGui::PopStyleColor();
      ui.name("step " + std::to_string(step));
    }
  }
  // Scrolls to the current step when it changes.
  ImGuiStorage& memory = *ImGui::GetStateStorage();
  const ImGuiID id = ImGui::GetID("shown");
  if (memory.GetInt(id, -1) != static_cast<int>(now)) {
    memory.SetInt(id, static_cast<int>(now));
    ImGui::SetScrollY(
        std::max(0.0f, (static_cast<float>(now - history.first()) - 0.5f * kRows) * row));
  }
  ImGui::EndChild();
  note(fmt::format("{:.1f} of {} MiB", static_cast<double>(history.bytes()) / (1 << 20),
                   history.budget() >> 20));
  ui.name("memory");
  const Rect covered = windowRect();
  ImGui::End();
  return covered;
}

}  // namespace lamplighter
