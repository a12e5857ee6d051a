// Panels that are about the user and not the level: settings, the log, toasts.
#pragma once

#include <cstdint>
#include <map>

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

struct Requests;

// A dialog while session.home().showsSettings.
struct SettingsState {
  std::string search;  // among the keys
};
void settingsDialog(PanelContext ui, SettingsState& state, Requests& requests);

struct LogState {
  uint64_t shown = 0;  // the newest notice that was scrolled to
};
void logPanel(PanelContext ui, LogState& state);

// The newest notices in the lower right corner of `view`, each for a while.
struct ToastState {
  std::map<uint64_t, float> seconds;  // that each was shown; by the notice's id
  uint64_t seen = 0;                  // the newest notice that became a toast
  bool any() const { return !seconds.empty(); }
};
void toasts(PanelContext ui, ToastState& state, const Rect& view, float dt);

}  // namespace lamplighter
