// Maps keys to actions. A preset overrides the default shortcuts of the actions. The user's file
// keys.json overrides the preset. It is an object of action texts and chords:
//
//   {"tool.move": "G", "light.add disk": "Ctrl+Shift+D", "view.vpls": ""}
//
// "" removes the keys of an action. Replays use the default shortcuts only.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/keys/action.h"

namespace lamplighter {

// Action texts and chords, in file order.
using KeyList = std::vector<std::pair<std::string, std::string>>;

// Each problem is one line with the entry and its error; the entry is ignored. Never throws for
// invalid text.
KeyList parseKeys(std::string_view text, std::vector<std::string>& problems);

// All keys. A later binding takes a key from an earlier one. Reports two entries of the file that
// use the same key, and actions that lose their key to the file.
KeyMap resolveKeys(const ActionRegistry& registry, const KeyList& preset, const KeyList& file,
                   std::vector<std::string>& problems);

}  // namespace lamplighter
