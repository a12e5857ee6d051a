// All actions, by name and as text. Menus, keys, recordings, scripts and tests call them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "editor/document/file_kinds.h"
#include "editor/input/event.h"
#include "editor/keys/chord.h"

namespace lamplighter {

class Session;

// An argument that is valid now, and its label in menus.
struct ActionChoice {
  std::string argument, label;
};

// What the user is asked for when an action is called without arguments. The answer is its
// argument.
struct ActionAsk {
  enum class Kind : uint8_t { openFile, saveFile, folder, name };
  Kind kind = Kind::openFile;
  std::string title;           // of the dialog
  Extensions extensions = {};  // of files; a file to save gets the first if it has none of them
  // The path or name that the dialog starts with; null: the level's path. Throws InputError if no
  // answer would be valid now.
  std::function<std::string(const Session&)> suggested = {};
  std::function<bool(const Session&)> when = {};  // null: always
  std::string answeredBy = {};  // the action that takes the answer; "": the one that asks
};

struct Action {
  std::string name;      // "light.add"
  std::string label;     // "Add area light"
  std::string usage;     // arguments: "rectangle|disk|sphere", "WIDTH [HEIGHT]", "FILE [FILE]…"
  std::string help;      // one sentence
  std::string shortcut;  // current shortcut: "Ctrl+D"; "" for none
  std::function<void(Session&, const std::vector<std::string>& arguments)> run;
  std::function<bool(const Session&)> enabled;  // null: always
  // does not end a drag in progress; other actions end it as its own undo step
  bool duringDrag = false;
  std::function<bool(const Session&)> checked;  // null: the action is not a toggle
  std::function<std::vector<ActionChoice>(const Session&)> choices;  // null: see `usage`
  // Why the action would show nothing now; "": it has an effect. It can run nevertheless, but menus
  // show it grey. Null: it always has an effect.
  std::function<std::string(const Session&)> problem;
  std::optional<ActionAsk> asks;
  // The level's file that the action overwrites with these arguments; "" if it writes none, or is
  // told to overwrite changes of other programs. The ui asks whether to overwrite such changes, and
  // then adds the argument `force`.
  std::function<std::filesystem::path(const Session&, const std::vector<std::string>& arguments)>
      saves;

  bool needsArguments() const { return !usage.empty() && usage.front() != '['; }
  // Whether that many arguments fit the usage: its words, with all of "[A B]" or none, and any
  // number of "[FILE]…".
  bool takes(size_t arguments) const;
  // Whether a call without arguments now asks the user.
  bool asksIn(const Session& session) const {
    return asks && (!enabled || enabled(session)) && (!asks->when || asks->when(session));
  }
};

// Keys by action text: "tool.move", "bookmark.go 3".
using KeyMap = std::map<std::string, std::vector<Chord>>;

class ActionRegistry {
 public:
  Action& add(Action action);
  // Binds a key to an action with these arguments, in addition to the shortcut of the action
  // itself.
  void addKey(const std::string& text, const std::string& shortcut);
  const Action* find(const std::string& name) const;
  const std::map<std::string, Action>& all() const { return actions_; }
  // A parsed "name arg arg". Arguments with spaces are in double quotes. Throws InputError if the
  // action does not exist, or for arguments if it takes none.
  struct Call {
    const Action& action;
    std::vector<std::string> arguments;
  };
  Call parse(std::string_view text) const;

  // The default keys, and the keys that are bound now. The shortcuts of the actions show the bound
  // keys.
  const KeyMap& defaultKeys() const { return defaultKeys_; }
  void setKeys(KeyMap keys);
  // Text for menus; "" for none.
  std::string keysOf(const std::string& text) const;
  // The action text that is bound to a key, "" for none; and its action, or null.
  std::string textForKey(Key key, Modifiers modifiers) const;
  const Action* forKey(Key key, Modifiers modifiers) const;

 private:
  std::map<std::string, Action> actions_;
  KeyMap defaultKeys_, keys_;
};

}  // namespace lamplighter
