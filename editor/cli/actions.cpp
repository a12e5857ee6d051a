#include <iostream>
#include <map>
#include <tuple>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/subcommands.h"
#include "editor/keys/key_bindings.h"
#include "editor/keys/key_presets.h"
#include "editor/session/register_actions.h"

namespace lamplighter::cli {

namespace {

std::string groupOf(const std::string& name) { return name.substr(0, name.find('.')); }

// Escapes vertical bars, which would end a table cell.
std::string cellOf(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// Keys of the action without and with arguments: "Alt+Left, Alt+Right". A long list shows only the
// first and the last key.
std::string keysOf(const ActionRegistry& registry, const Action& action) {
  std::vector<std::string> keys;
  if (!action.shortcut.empty()) keys.push_back(action.shortcut);
  for (const auto& [text, chords] : registry.defaultKeys())
    if (text.starts_with(action.name + " ")) keys.push_back(chordsText(chords));
  if (keys.size() > 6) return keys.front() + " \u2026 " + keys.back();
  return fmt::format("{}", fmt::join(keys, ", "));
}

void printJson(const ActionRegistry& registry) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const auto& [name, a] : registry.all())
    all.push_back({{"name", name},
                   {"label", a.label},
                   {"arguments", a.usage},
                   {"help", a.help},
                   {"shortcut", keysOf(registry, a)}});
  std::cout << all.dump(2) << '\n';
}

// Sorts by key: letters and digits before keys with longer names, fewer modifiers before more.
struct ByKey {
  static auto rank(const Chord& c) {
    const std::string key = keyName(c.key);
    const int held =
        (c.modifiers.ctrl ? 4 : 0) + (c.modifiers.alt ? 2 : 0) + (c.modifiers.shift ? 1 : 0);
    return std::tuple(key.size() > 1, static_cast<int>(c.key), held);
  }
  bool operator()(const Chord& a, const Chord& b) const { return rank(a) < rank(b); }
};

using ActionOfKey = std::map<Chord, std::string, ByKey>;

ActionOfKey actionOfKey(const ActionRegistry& registry, const std::string& preset) {
  ActionOfKey out;
  std::vector<std::string> problems;  // a preset has no problems
  for (const auto& [text, chords] : resolveKeys(registry, keysOfPreset(preset), {}, problems))
    for (const Chord& chord : chords) out[chord] = text;
  return out;
}

// Prints the action of each key, and the action in the other presets if it differs.
void printKeys(const ActionRegistry& registry) {
  const std::vector<std::string> presets = keyPresetNames();
  std::vector<ActionOfKey> columns;
  ActionOfKey all;
  for (const std::string& preset : presets) {
    columns.push_back(actionOfKey(registry, preset));
    all.insert(columns.back().begin(), columns.back().end());
  }
  std::cout << "\n## Keys\n\nKeys by the presets of the setting `keys`. An empty cell: the key "
               "does the same as in the first column. A dash: the key does nothing.\n\n| key |";
  for (const std::string& preset : presets) std::cout << " `" << preset << "` |";
  std::cout << "\n| --- |";
  for (size_t i = 0; i < presets.size(); ++i) std::cout << " --- |";
  std::cout << '\n';
  const auto textOf = [](const ActionOfKey& column, const Chord& chord) {
    const auto it = column.find(chord);
    return it == column.end() ? std::string("\u2013") : "`" + cellOf(it->second) + "`";
  };
  for (const auto& [chord, ignored] : all) {
    const std::string first = textOf(columns.front(), chord);
    std::cout << "| " << chordText(chord) << " | " << first << " |";
    for (size_t i = 1; i < columns.size(); ++i) {
      const std::string here = textOf(columns[i], chord);
      std::cout << (here == first ? "" : " " + here) << " |";
    }
    std::cout << '\n';
  }
}

void printMarkdown(const ActionRegistry& registry) {
  std::cout << "# Actions\n\nWritten by `lamplighter actions --markdown`. Menus, keys, the command "
               "palette (Ctrl+P), recordings and `lamplighter script` all run these.\n";
  std::string group;
  for (const auto& [name, a] : registry.all()) {
    if (groupOf(name) != group) {
      group = groupOf(name);
      std::cout << fmt::format("\n## {}\n\n| action | key | |\n| --- | --- | --- |\n", group);
    }
    const std::string usage = a.usage.empty() ? name : name + " " + a.usage;
    std::cout << fmt::format("| `{}` | {} | {} |\n", cellOf(usage), keysOf(registry, a),
                             cellOf(a.help));
  }
  printKeys(registry);
}

void printText(const ActionRegistry& registry) {
  for (const auto& [name, a] : registry.all())
    std::cout << fmt::format("{}{}{}{}\n    {}\n", name, a.usage.empty() ? "" : " ", a.usage,
                             keysOf(registry, a).empty() ? "" : "  (" + keysOf(registry, a) + ")",
                             a.help);
}

}  // namespace

int actions(const ActionsOptions& options) {
  ActionRegistry registry;
  addAllActions(registry);
  if (options.json) {
    printJson(registry);
  } else if (options.markdown) {
    printMarkdown(registry);
  } else {
    printText(registry);
  }
  return 0;
}

}  // namespace lamplighter::cli
