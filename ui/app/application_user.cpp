// The user's preferences in the application: the scale, and the borders of the layout.
#include <algorithm>
#include <array>
#include <utility>

#include <imgui_internal.h>

#include "editor/document/cache_folder.h"
#include "editor/session/apply.h"
#include "editor/session/user_state.h"
#include "ui/app/application.h"
#include "ui/platform/ui_scale.h"

namespace lamplighter {

Application::~Application() { flushPreferences(); }

void Application::setUser(std::unique_ptr<UserFiles> files, Preferences preferences) {
  session_->home().preferences = std::move(preferences);
  session_->home().fileKeys = files->readKeys();
  for (const std::string& problem : files->problems())
    session_->setStatus(problem, NoticeKind::warning);
  std::vector<std::string> problems;
  applyPreferences(*session_, problems);
  for (const std::string& problem : problems)
    session_->setStatus("keys.json: " + problem, NoticeKind::warning);
  applyPreset(*session_);
  userFiles_ = std::move(files);
  thumbnails_.setCacheFolder(thumbnailFolder());
}

float Application::uiScale() const {
  const float factor = session_->home().preferences.settings().uiScale;
  return std::clamp(platform_.contentScale() * factor, kLeastUiScale, kMostUiScale);
}

// Call once per frame before the panels: changed settings move the borders, and dragged borders
// change the settings.
void Application::exchangePreferences() {
  Preferences& p = session_->home().preferences;
  if (p.values != appliedPreferences_) {
    const UserSettings s = p.settings();
    layout_.setSizes({s.leftWidth, s.rightWidth, s.bottomHeight, s.renderShare});
  } else {
    const LayoutSizes& sizes = layout_.sizes();
    const auto keep = [&](const char* name, float value) {
      const ParameterSpec& spec = preferenceNamed(name);
      p.set(name,
            std::clamp(value, static_cast<float>(spec.minimum), static_cast<float>(spec.maximum)));
    };
    keep("left_width", sizes.left);
    keep("right_width", sizes.right);
    keep("bottom_height", sizes.bottom);
    keep("render_share", sizes.renderShare);
  }
  takePreferences(*session_);
  // Independent of the panel: a program that waits for thumbnails is not idle.
  if (platform_.hasGl()) thumbnails_.update();
  appliedPreferences_ = p.values;
  if (!userFiles_) return;
  const glm::ivec2 size = platform_.windowSize();
  if (size.x >= 640 && size.y >= 400 && size.x <= 16384 && size.y <= 16384) {
    p.set("window_width", size.x);
    p.set("window_height", size.y);
    appliedPreferences_ = p.values;
  }
  userFiles_->keep(p);
  if (const std::string problem = userFiles_->takeWriteProblem(); !problem.empty())
    session_->setStatus(problem, NoticeKind::error);
}

void Application::drawBottom(const PanelContext& ui) {
  switch (session_->home().bottom) {
    case BottomPanel::none:
      return lightTable(ui, lightTableState_, requests_);
    case BottomPanel::log:
      return logPanel(ui, logState_);
    case BottomPanel::assets:
      break;
  }
  assetPanel(ui, assetState_, platform_.hasGl() ? &thumbnails_ : nullptr, requests_);
}

namespace {

// Gives a window the keyboard focus and selects its first item.
void focus(ImGuiWindow* window, ImGuiNavLayer layer) {
  ImGui::FocusWindow(window);
  ImGuiContext& g = *ImGui::GetCurrentContext();
  g.NavLayer = layer;
  g.NavDisableHighlight = false;
  g.NavDisableMouseHover = true;
  ImGui::NavInitWindow(window, true);
}

}  // namespace

// Cycles through the visible panels, in the order of the window.
void Application::focusPanel(int step) {
  static constexpr std::array kPanels = {"##viewport",  "##toolbar", "##outliner",
                                         "##inspector", "##render",  "##lights"};
  const ImGuiContext& g = *ImGui::GetCurrentContext();
  const ImGuiWindow* now = g.NavWindow != nullptr ? g.NavWindow->RootWindow : nullptr;
  const int count = static_cast<int>(kPanels.size());
  int at = 0;
  for (int i = 0; i < count; ++i)
    if (now != nullptr && now == ImGui::FindWindowByName(kPanels[static_cast<size_t>(i)])) at = i;
  for (int i = 1; i <= count; ++i) {
    const int next = ((at + step * i) % count + count) % count;
    ImGuiWindow* window = ImGui::FindWindowByName(kPanels[static_cast<size_t>(next)]);
    if (window == nullptr || !window->WasActive) continue;
    return focus(window, ImGuiNavLayer_Main);
  }
}

// Call within a frame: the first item of the panel is found while the panel is drawn.
void Application::focusAsAsked() {
  const std::optional<int> step = std::exchange(session_->home().focusStep, std::nullopt);
  if (!step) return;
  if (*step != 0) return focusPanel(*step);
  if (ImGuiWindow* bar = ImGui::FindWindowByName("##MainMenuBar")) focus(bar, ImGuiNavLayer_Menu);
}

void Application::flushPreferences() {
  if (userFiles_) userFiles_->flush(session_->home().preferences);
}

}  // namespace lamplighter
