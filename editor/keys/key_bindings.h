// Which keys run which actions: the actions' own shortcuts, over these a preset's, over those the
// user's file keys.json, an object of action text and chord:
//
//   {"tool.move": "G", "light.add disk": "Ctrl+Shift+D", "view.vpls": ""}
//
// "" takes the keys away. Recordings are played with the actions' own shortcuts.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "editor/keys/action.h"

namespace lamplighter {

// Action texts and chords, in the order given.
using KeyList = std::vector<std::pair<std::string, std::string>>;

// Each problem is one line that says which entry and what is wrong with it; the entry is left out.
// Never throws for a bad text.
KeyList parseKeys(std::string_view text, std::vector<std::string>& problems);

// All keys. What is bound later takes the key from what had it; two entries of the file that want
// the same key, and actions that lose theirs to the file, are told.
KeyMap resolveKeys(const ActionRegistry& registry, const KeyList& preset, const KeyList& file,
                   std::vector<std::string>& problems);

}  // namespace lamplighter
