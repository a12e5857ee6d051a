// A key with what is held with it, and its text: "Ctrl+Shift+Z".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/input/event.h"

namespace lamplighter {

struct Chord {
  Key key = Key::none;
  Modifiers modifiers;
  bool operator==(const Chord&) const = default;
};

// None: it names no key, or holds what is no modifier.
std::optional<Chord> parseChord(const std::string& text);
std::string chordText(const Chord& chord);
// Several ways to press the same: "Ctrl+Y, Ctrl+Shift+Z". None where one of them is no chord.
std::optional<std::vector<Chord>> parseChords(const std::string& text);
std::string chordsText(const std::vector<Chord>& chords);

}  // namespace lamplighter
