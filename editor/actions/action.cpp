#include "editor/actions/action.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "editor/session.h"
#include "renderer/error.h"

namespace lamplighter {

namespace {

// Words split at spaces; double quotes hold a word together, \" within them is a quote.
std::vector<std::string> split(std::string_view text) {
  std::vector<std::string> words;
  bool inWord = false, inQuotes = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (inQuotes && c == '\\' && i + 1 < text.size()) {
      words.back() += text[++i];
    } else if (c == '"') {
      if (!inWord) words.emplace_back();
      inWord = true;
      inQuotes = !inQuotes;
    } else if (c == ' ' && !inQuotes) {
      inWord = false;
    } else {
      if (!inWord) words.emplace_back();
      inWord = true;
      words.back() += c;
    }
  }
  if (inQuotes) throw InputError(std::string(text), "a quote is not closed", "close it with \"");
  return words;
}

// "Ctrl+Shift+Z" → the key and what is held with it.
std::pair<Key, Modifiers> parseShortcut(const std::string& text) {
  Modifiers m;
  size_t from = 0;
  for (size_t plus = text.find('+'); plus != std::string::npos; plus = text.find('+', from)) {
    const std::string part = text.substr(from, plus - from);
    (part == "Ctrl" ? m.ctrl : part == "Shift" ? m.shift : m.alt) = true;
    from = plus + 1;
  }
  std::string key = text.substr(from);
  std::transform(key.begin(), key.end(), key.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return {keyOf(key), m};
}

}  // namespace

void ActionRegistry::add(Action action) {
  const std::string name = action.name;
  actions_.emplace(name, std::move(action));
}

const Action* ActionRegistry::find(const std::string& name) const {
  const auto it = actions_.find(name);
  return it == actions_.end() ? nullptr : &it->second;
}

void ActionRegistry::run(Session& session, std::string_view text) const {
  std::vector<std::string> words = split(text);
  if (words.empty()) throw InputError("action", "is empty", "give a name such as edit.undo");
  const Action* action = find(words.front());
  if (action == nullptr)
    throw InputError(words.front(), "there is no such action", "look at the menus for their names");
  words.erase(words.begin());
  if (action->usage.empty() && !words.empty())
    throw InputError(action->name, "takes no arguments", "give the name alone");
  if (!action->duringDrag) session.finishDrag();
  if (action->enabled && !action->enabled(session)) return;
  action->run(session, words);
}

const Action* ActionRegistry::forKey(Key key, Modifiers modifiers) const {
  if (key == Key::none) return nullptr;
  for (const auto& [name, action] : actions_) {
    // Several ways to press it: "Ctrl+Y, Ctrl+Shift+Z".
    for (size_t from = 0; from < action.shortcut.size();) {
      size_t end = action.shortcut.find(", ", from);
      if (end == std::string::npos) end = action.shortcut.size();
      const auto [k, m] = parseShortcut(action.shortcut.substr(from, end - from));
      if (k == key && m == modifiers) return &action;
      from = end + 2;
    }
  }
  return nullptr;
}

}  // namespace lamplighter
