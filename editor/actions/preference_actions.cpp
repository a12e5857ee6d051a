// Actions of the user's settings and of panels that do not belong to a level.
#include <spdlog/fmt/fmt.h>

#include "editor/actions/arguments.h"
#include "editor/session/apply.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

void apply(Session& s) {
  std::vector<std::string> problems;
  applyPreferences(s, problems);
  for (const std::string& problem : problems)
    s.setStatus("keys.json: " + problem, NoticeKind::warning);
}

void addPanel(ActionRegistry& r, const char* name, const char* label, const char* help,
              const char* shortcut, BottomPanel panel) {
  r.add({name, label, "", help, shortcut,
         [panel](Session& s, const Arguments&) {
           BottomPanel& shown = s.home().bottom;
           shown = shown == panel ? BottomPanel::none : panel;
           // there is room for only one of them
           if (shown != BottomPanel::none) s.lighting().showsTable = false;
         },
         nullptr, true, [panel](const Session& s) { return s.home().bottom == panel; }});
}

}  // namespace

void addPreferenceActions(ActionRegistry& r) {
  r.add({"settings.set", "Change setting", "NAME=VALUE",
         "Changes one of the user's settings (docs/reference/settings.md).", "",
         [](Session& s, const Arguments& a) {
           const size_t equals = a[0].find('=');
           if (equals == std::string::npos)
             throw InputError(a[0], "does not change a setting", "give NAME=VALUE");
           takePreferences(s);
           s.home().preferences.setText(a[0].substr(0, equals), a[0].substr(equals + 1));
           apply(s);
         },
         nullptr, true});
  r.add({"settings.reset", "Reset settings", "[NAME]",
         "Resets one setting, or all of them, to the default.", "",
         [](Session& s, const Arguments& a) {
           takePreferences(s);
           Preferences& p = s.home().preferences;
           if (a.empty())
             p.values = {};
           else
             p.values.reset(preferenceNamed(a[0]).name);
           apply(s);
         },
         nullptr, true});
  r.add({"settings.show", "Settings\u2026", "", "Shows the user's settings.", "Ctrl+Comma",
         [](Session& s, const Arguments&) { s.home().showsSettings = true; }, nullptr, true});
  r.add({"view.ui_scale", "UI scale", fmt::format("{}", fmt::join(offeredValues("ui_scale"), "|")),
         "Sets the size of the user interface, relative to the scale of the screen, from 0.5 to 4.",
         "", [](Session& s, const Arguments& a) { s.home().preferences.setText("ui_scale", a[0]); },
         nullptr, true});
  const auto addFocus = [&](const char* name, const char* label, const char* help,
                            const char* shortcut, int step) {
    r.add({name, label, "", help, shortcut,
           [step](Session& s, const Arguments&) { s.home().focusStep = step; }, nullptr, true});
  };
  addFocus("panel.next", "Next panel",
           "Moves the keyboard focus to the next panel. Arrow keys move within it.", "F6, Ctrl+Tab",
           1);
  addFocus("panel.previous", "Previous panel", "Moves the keyboard focus to the previous panel.",
           "Shift+F6, Ctrl+Shift+Tab", -1);
  addFocus("app.menu", "Menu bar", "Moves the keyboard focus to the menu bar.", "F10", 0);
  addPanel(r, "panel.assets", "Assets", "Shows the asset browser, below the view.", "B",
           BottomPanel::assets);
  addPanel(r, "panel.log", "Log", "Shows all messages since the program started, below the view.",
           "Shift+N", BottomPanel::log);
}

}  // namespace lamplighter
