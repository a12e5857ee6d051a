#include <iostream>

#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

#include "editor/actions/register_actions.h"
#include "editor/cli/subcommands.h"

namespace lamplighter::cli {

namespace {

std::string groupOf(const std::string& name) { return name.substr(0, name.find('.')); }

// A bar would end a cell of a table.
std::string cellOf(const std::string& text) {
  std::string out;
  for (const char c : text) out += c == '|' ? std::string("\\|") : std::string(1, c);
  return out;
}

// Of the action itself and with arguments: "Alt+Left, Alt+Right", or from the first to the last of
// many.
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
