// settings.json and keys.json, which users edit by hand. Valid entries are used, others are
// reported in one line each, and the used entries stay the same when written and read again.
#include <algorithm>

#include "editor/keys/key_bindings.h"
#include "editor/preferences/preferences_file.h"
#include "editor/session/register_actions.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

namespace {

const ActionRegistry& registry() {
  static const ActionRegistry kRegistry = [] {
    ActionRegistry r;
    addAllActions(r);
    return r;
  }();
  return kRegistry;
}

void checkLines(const std::vector<std::string>& problems) {
  for (const std::string& p : problems) {
    const bool isLine = std::none_of(p.begin(), p.end(), [](unsigned char c) { return c < ' '; });
    if (!isLine || p.empty() || p.size() > 1000) fuzz::broken("a problem is a line: " + p);
  }
}

void checkSettings(std::string_view text) {
  std::vector<std::string> problems;
  const Preferences taken = parsePreferences(text, problems);
  checkLines(problems);
  if (taken == Preferences()) return;
  problems.clear();
  if (parsePreferences(preferencesText(taken), problems) != taken || !problems.empty())
    fuzz::broken("the same settings again: " + preferencesText(taken));
  if (taken.recentFiles.size() > Preferences::kMostRecent) fuzz::broken("few recent files");
  for (const auto& [name, value] : taken.values.values())
    Settings::parse(preferenceNamed(name), Settings::format(value));  // throws beyond its limits
}

void checkKeys(std::string_view text) {
  std::vector<std::string> problems;
  const KeyList file = parseKeys(text, problems);
  if (!file.empty()) {
    const KeyMap keys = resolveKeys(registry(), {}, file, problems);
    for (const auto& [action, given] : file) {
      const auto own = keys.find(action);
      if (own == keys.end()) continue;  // there is no such action
      if (parseChords(chordsText(own->second)) != own->second)
        fuzz::broken("the same keys again: " + action);
      for (const Chord& c : own->second)
        for (const auto& [other, chords] : keys)
          if (other != action && std::find(chords.begin(), chords.end(), c) != chords.end())
            fuzz::broken("a key of one action: " + chordText(c));
    }
  }
  checkLines(problems);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  checkSettings(fuzz::textOf(data, size));
  checkKeys(fuzz::textOf(data, size));
  return 0;
}
