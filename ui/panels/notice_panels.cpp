// Shows notices: toasts for the newest, the log for all.
#include <algorithm>

#include "editor/session/user_state.h"
#include "ui/panels/user_panels.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr size_t kMostToasts = 4;

unsigned colourOf(NoticeKind kind) {
  switch (kind) {
    case NoticeKind::info:
    case NoticeKind::hint:
      return theme::kText;
    case NoticeKind::warning:
      return theme::kWarning;
    case NoticeKind::error:
      break;
  }
  return 0xe06a5a;
}

bool isBad(const Notice& notice) {
  return notice.kind == NoticeKind::warning || notice.kind == NoticeKind::error;
}

std::string textOf(const Notice& notice) {
  const std::string times = notice.count > 1 ? "  \u00d7" + std::to_string(notice.count) : "";
  return (isBad(notice) ? withIcon(icon::kWarning, notice.text) : notice.text) + times;
}

// Updates the list of toasts: adds new notices and removes expired ones.
void advance(const PanelContext& ui, ToastState& state, float dt) {
  const auto& all = ui.session.home().notices.all();
  const UserSettings settings = ui.session.home().preferences.settings();
  const float stays = settings.toastSeconds;
  for (const Notice& notice : all) {
    if (notice.id > state.seen) state.seconds[notice.id] = 0.0f;
  }
  if (!all.empty()) state.seen = std::max(state.seen, all.back().id);
  for (auto it = state.seconds.begin(); it != state.seconds.end();) {
    const auto notice =
        std::find_if(all.begin(), all.end(), [&](const Notice& n) { return n.id == it->first; });
    it->second += dt;
    const float most = notice != all.end() && isBad(*notice) ? 2 * stays : stays;
    it = notice == all.end() || it->second > most ? state.seconds.erase(it) : std::next(it);
  }
  while (state.seconds.size() > kMostToasts) state.seconds.erase(state.seconds.begin());
  if (!settings.toasts) state.seconds.clear();
}

}  // namespace

void toasts(PanelContext ui, ToastState& state, const Rect& view, float dt) {
  ui.prefix = "toast/";
  advance(ui, state, dt);
  if (view.empty()) return;
  const float width = std::min(ui.px(340), view.size().x - ui.px(24));
  float lowest = view.max.y - ui.px(12);
  int number = 0;
  for (auto it = state.seconds.rbegin(); it != state.seconds.rend(); ++it, ++number) {
    const auto& all = ui.session.home().notices.all();
    const auto notice =
        std::find_if(all.begin(), all.end(), [&](const Notice& n) { return n.id == it->first; });
    const std::string text = textOf(*notice);
    const ImVec2 pad{ui.px(10), ui.px(7)};
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), nullptr, false, width - 2 * pad.x);
    const float height = size.y + 2 * pad.y, wide = size.x + 2 * pad.x;
    if (lowest - height < view.min.y) break;
    const Rect rect{{view.max.x - ui.px(12) - wide, lowest - height},
                    {view.max.x - ui.px(12), lowest}};
    lowest -= height + ui.px(6);
    // Above the view and below menus and dialogs. Clicks pass through.
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    list.AddRectFilled({rect.min.x, rect.min.y}, {rect.max.x, rect.max.y},
                       theme::colour(theme::kPanel, 240), ui.px(4));
    list.AddRect({rect.min.x, rect.min.y}, {rect.max.x, rect.max.y},
                 theme::colour(isBad(*notice) ? colourOf(notice->kind) : theme::kLine), ui.px(4));
    list.AddText(ImGui::GetFont(), ImGui::GetFontSize(), {rect.min.x + pad.x, rect.min.y + pad.y},
                 theme::colour(colourOf(notice->kind)), text.c_str(), nullptr, width - 2 * pad.x);
    ui.widgets.add(ui.prefix + std::to_string(number), rect, rect);
  }
}

void logPanel(PanelContext ui, LogState& state) {
  ui.prefix = "log/";
  Notices& notices = ui.session.home().notices;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("Log");
  ImGui::SameLine();
  if (ImGui::SmallButton("Clear")) notices.clear();
  ui.name("clear");
  ImGui::SameLine();
  if (ImGui::SmallButton("Copy")) {
    std::string text;
    for (const Notice& notice : notices.all()) text += notice.text + '\n';
    ImGui::SetClipboardText(text.c_str());
  }
  ui.name("copy");
  ImGui::BeginChild("lines");
  int number = 0;
  for (const Notice& notice : notices.all()) {
    ImGui::PushStyleColor(ImGuiCol_Text, theme::colour(colourOf(notice.kind)));
    ImGui::PushTextWrapPos(0.0f);
    ImGui::TextUnformatted(textOf(notice).c_str());
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ui.name("line " + std::to_string(number++));
  }
  if (!notices.all().empty() && notices.all().back().id != state.shown) {
    state.shown = notices.all().back().id;
    ImGui::SetScrollHereY(1.0f);
  }
  ImGui::EndChild();
}

}  // namespace lamplighter
