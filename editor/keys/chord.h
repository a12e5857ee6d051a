// A key with its modifiers, and its text form: "Ctrl+Shift+Z".
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

// None if the text has no key or an unknown modifier.
std::optional<Chord> parseChord(const std::string& text);
std::string chordText(const Chord& chord);
// Alternative chords: "Ctrl+Y, Ctrl+Shift+Z". None if one of them is not a chord.
std::optional<std::vector<Chord>> parseChords(const std::string& text);
std::string chordsText(const std::vector<Chord>& chords);

}  // namespace lamplighter
