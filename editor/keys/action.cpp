#include "editor/keys/action.h"

#include <algorithm>
#include <utility>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Splits words at spaces. Double quotes keep a word together; \" within them is a quote.
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

size_t wordsIn(std::string_view text) {
  size_t words = 0;
  for (size_t i = 0; i < text.size(); ++i)
    if (text[i] != ' ' && (i == 0 || text[i - 1] == ' ')) ++words;
  return words;
}

}  // namespace

bool Action::takes(size_t arguments) const {
  const std::string_view all = usage;
  const size_t required = wordsIn(all.substr(0, all.find('['))), most = wordsIn(all);
  return arguments == required || arguments == most ||
         (all.ends_with("]…") && arguments > required);
}

Action& ActionRegistry::add(Action action) {
  const std::string name = action.name;
  addKey(name, action.shortcut);
  return actions_.emplace(name, std::move(action)).first->second;
}

void ActionRegistry::addKey(const std::string& text, const std::string& shortcut) {
  if (shortcut.empty()) return;
  defaultKeys_[text] = parseChords(shortcut).value();
  keys_[text] = defaultKeys_[text];
}

const Action* ActionRegistry::find(const std::string& name) const {
  const auto it = actions_.find(name);
  return it == actions_.end() ? nullptr : &it->second;
}

ActionRegistry::Call ActionRegistry::parse(std::string_view text) const {
  std::vector<std::string> words = split(text);
  if (words.empty()) throw InputError("action", "is empty", "give a name such as edit.undo");
  const Action* action = find(words.front());
  if (action == nullptr)
    throw InputError(words.front(), "there is no such action",
                     "the command palette lists all actions");
  words.erase(words.begin());
  if (action->usage.empty() && !words.empty())
    throw InputError(action->name, "takes no arguments", "give the name alone");
  return {*action, std::move(words)};
}

void ActionRegistry::setKeys(KeyMap keys) {
  keys_ = std::move(keys);
  for (auto& [name, action] : actions_) action.shortcut = keysOf(name);
}

std::string ActionRegistry::keysOf(const std::string& text) const {
  const auto it = keys_.find(text);
  return it == keys_.end() ? "" : chordsText(it->second);
}

std::string ActionRegistry::textForKey(Key key, Modifiers modifiers) const {
  const Chord pressed{key, modifiers};
  for (const auto& [text, chords] : keys_) {
    if (std::find(chords.begin(), chords.end(), pressed) != chords.end()) return text;
  }
  return "";
}

const Action* ActionRegistry::forKey(Key key, Modifiers modifiers) const {
  const std::string text = textForKey(key, modifiers);
  return text.empty() ? nullptr : find(text.substr(0, text.find(' ')));
}

}  // namespace lamplighter
