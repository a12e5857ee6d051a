// Panels for the user rather than the level: settings, log, toasts.
#pragma once

#include <cstdint>
#include <map>

#include "ui/widgets/rect.h"
#include "ui/widgets/widgets.h"

namespace lamplighter {

struct Requests;

// A dialog that is open while session.home().showsSettings.
struct SettingsState {
  std::string search;  // filters the keys
};
void settingsDialog(PanelContext ui, SettingsState& state, Requests& requests);

struct LogState {
  uint64_t shown = 0;  // the newest notice that the log has scrolled to
};
void logPanel(PanelContext ui, LogState& state);

// The newest notices in the lower right corner of `view`, each for a limited time.
struct ToastState {
  std::map<uint64_t, float> seconds;  // display time so far, by the id of the notice
  uint64_t seen = 0;                  // the newest notice that became a toast
  bool any() const { return !seconds.empty(); }
};
void toasts(PanelContext ui, ToastState& state, const Rect& view, float dt);

}  // namespace lamplighter
