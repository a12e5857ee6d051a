// Every action by name and as text. Menus, keys, recordings, scripts and tests all call these.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "editor/input/event.h"
#include "editor/keys/chord.h"

namespace lamplighter {

class Session;

// An argument that fits now, and what menus call it.
struct ActionChoice {
  std::string argument, label;
};

struct Action {
  std::string name;      // "light.add"
  std::string label;     // "Add area light"
  std::string usage;     // arguments: "rectangle|disk|sphere"
  std::string help;      // one sentence
  std::string shortcut;  // "Ctrl+D", "" for none; what is bound now
  std::function<void(Session&, const std::vector<std::string>& arguments)> run;
  std::function<bool(const Session&)> enabled;  // null: always
  bool duringDrag = false;  // leaves a drag under way alone; others end it as a step of its own
  std::function<bool(const Session&)> checked;                       // null: it switches nothing
  std::function<std::vector<ActionChoice>(const Session&)> choices;  // null: as `usage` says
};

// The keys of action texts: "tool.move", "bookmark.go 3".
using KeyMap = std::map<std::string, std::vector<Chord>>;

class ActionRegistry {
 public:
  void add(Action action);
  // A key for an action with these arguments, besides the shortcut of the action itself.
  void addKey(const std::string& text, const std::string& shortcut);
  const Action* find(const std::string& name) const;
  const std::map<std::string, Action>& all() const { return actions_; }
  // What "name arg arg" asks for; arguments with spaces in double quotes. Throws InputError for a
  // name that there is not, or arguments where it takes none.
  struct Call {
    const Action& action;
    std::vector<std::string> arguments;
  };
  Call parse(std::string_view text) const;

  // The keys that the actions come with, and those that are bound now; the shortcuts of actions are
  // what is bound.
  const KeyMap& defaultKeys() const { return defaultKeys_; }
  void setKeys(KeyMap keys);
  // As menus show them, "" for none.
  std::string keysOf(const std::string& text) const;
  // The text bound to a key, "" for none; and the action that it names, or null.
  std::string textForKey(Key key, Modifiers modifiers) const;
  const Action* forKey(Key key, Modifiers modifiers) const;

 private:
  std::map<std::string, Action> actions_;
  KeyMap defaultKeys_, keys_;
};

}  // namespace lamplighter
