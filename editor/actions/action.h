// Every action by name and as text. Menus, keys, recordings, scripts and tests all call these.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "editor/input/event.h"

namespace lamplighter {

class Session;

struct Action {
  std::string name;      // "light.add"
  std::string label;     // "Add area light"
  std::string usage;     // arguments: "rectangle|disk|sphere"
  std::string help;      // one sentence
  std::string shortcut;  // "Ctrl+D", "" for none; rebindable
  std::function<void(Session&, const std::vector<std::string>& arguments)> run;
  std::function<bool(const Session&)> enabled;  // null: always
  bool duringDrag = false;  // leaves a drag under way alone; others end it as a step of its own
  std::function<bool(const Session&)> checked;  // null: it switches nothing
};

class ActionRegistry {
 public:
  void add(Action action);
  const Action* find(const std::string& name) const;
  const std::map<std::string, Action>& all() const { return actions_; }
  // Runs "name arg arg"; arguments with spaces in double quotes. Throws InputError for a name or
  // arguments that do not fit, with the document untouched. A disabled action does nothing.
  void run(Session& session, std::string_view text) const;
  // The action bound to a key, or null.
  const Action* forKey(Key key, Modifiers modifiers) const;

 private:
  std::map<std::string, Action> actions_;
};

}  // namespace lamplighter
