#include "editor/keys/chord.h"

#include <cctype>

#include "renderer/base/text.h"

namespace lamplighter {

std::optional<Chord> parseChord(const std::string& text) {
  Chord chord;
  size_t from = 0;
  for (size_t plus = text.find('+'); plus != std::string::npos; plus = text.find('+', from)) {
    const std::string part = text.substr(from, plus - from);
    bool* held = part == "Ctrl"    ? &chord.modifiers.ctrl
                 : part == "Shift" ? &chord.modifiers.shift
                 : part == "Alt"   ? &chord.modifiers.alt
                                   : nullptr;
    if (held == nullptr || *held) return std::nullopt;
    *held = true;
    from = plus + 1;
  }
  chord.key = keyOf(lowerCase(text.substr(from)));
  const bool isModifier = chord.key >= Key::shift;
  return chord.key == Key::none || isModifier ? std::nullopt : std::optional(chord);
}

std::string chordText(const Chord& chord) {
  std::string key = keyName(chord.key);
  key[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(key[0])));
  return std::string(chord.modifiers.ctrl ? "Ctrl+" : "") + (chord.modifiers.alt ? "Alt+" : "") +
         (chord.modifiers.shift ? "Shift+" : "") + key;
}

std::optional<std::vector<Chord>> parseChords(const std::string& text) {
  std::vector<Chord> out;
  for (size_t from = 0; from < text.size();) {
    size_t end = text.find(", ", from);
    if (end == std::string::npos) end = text.size();
    const auto chord = parseChord(text.substr(from, end - from));
    if (!chord) return std::nullopt;
    out.push_back(*chord);
    from = end + 2;
  }
  return out;
}

std::string chordsText(const std::vector<Chord>& chords) {
  std::string out;
  for (const Chord& chord : chords) out += (out.empty() ? "" : ", ") + chordText(chord);
  return out;
}

}  // namespace lamplighter
