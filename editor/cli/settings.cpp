#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/cli/parameter_range.h"
#include "editor/cli/subcommands.h"
#include "editor/preferences/preferences.h"

namespace lamplighter::cli {

namespace {

void printSettingsJson() {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const PreferenceSection& section : preferenceSections()) {
    for (const ParameterSpec& p : section.table.specs()) {
      nlohmann::ordered_json j{{"name", p.name}, {"label", p.label}, {"section", section.label},
                               {"unit", p.unit}, {"help", p.help},   {"range", rangeOf(p)}};
      std::visit([&](const auto& v) { j["default"] = v; }, p.defaultValue);
      all.push_back(j);
    }
  }
  std::cout << all.dump(2) << '\n';
}

void printSettingsMarkdown() {
  std::cout
      << "# Settings\n\nWritten by `lamplighter settings --markdown`. The panel *Settings* "
         "(Ctrl+Comma) and the actions `settings.set NAME=VALUE` and `settings.reset [NAME]` "
         "change them.\n\nThe editor's window reads `settings.json` and `keys.json` in "
         "`$XDG_CONFIG_HOME/lamplighter` (`~/.config/lamplighter`) when it starts, and writes the "
         "first when something changed: a whole new file that takes the old one's place. "
         "`--record`, `replay`, `script` and the other subcommands read neither. Invalid settings "
         "are reported, one line each, and get their default; the invalid file is kept as "
         "`settings.json.broken-1`, `-2` and so on. The file also holds the recent files, the "
         "favourite folders of the file dialog and the folder of the asset browser.\n";
  for (const PreferenceSection& section : preferenceSections()) {
    std::cout << fmt::format(
        "\n## {}\n\n| name | unit | default | range | |\n| --- | --- | --- | --- | --- |\n",
        section.label);
    for (const ParameterSpec& p : section.table.specs())
      std::cout << fmt::format("| `{}` | {} | {} | {} | {} |\n", p.name, p.unit,
                               Settings::format(p.defaultValue), rangeOf(p), p.help);
  }
  std::cout
      << "\n## keys.json\n\nAn object of action texts ([actions.md](actions.md), with their "
         "arguments) and keys, over those of the setting `keys`:\n\n    {\"tool.move\": \"G\", "
         "\"light.add disk\": \"Ctrl+Shift+D\", \"view.vpls\": \"\", \"edit.redo\": "
         "\"Ctrl+Y, Ctrl+Shift+Z\"}\n\nAn empty text removes the keys. A key that belonged to "
         "another action is removed from that action. Unknown actions, unknown keys and keys "
         "that are bound twice are reported, one line each, in a toast and in the log (Shift+N). "
         "The file is "
         "never written.\n";
}

void printSettingsText() {
  for (const PreferenceSection& section : preferenceSections()) {
    for (const ParameterSpec& p : section.table.specs())
      std::cout << fmt::format("{} = {}{}  ({})\n    {}\n", p.name,
                               Settings::format(p.defaultValue), p.unit.empty() ? "" : " " + p.unit,
                               rangeOf(p), p.help);
  }
}

}  // namespace

int settings(const SettingsOptions& options) {
  if (options.json)
    printSettingsJson();
  else if (options.markdown)
    printSettingsMarkdown();
  else
    printSettingsText();
  return 0;
}

}  // namespace lamplighter::cli
