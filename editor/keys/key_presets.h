// Presets of keys for the most used tools: by keyboard row (W E R), or by initials (G R S for grab,
// rotate, scale).
#pragma once

#include <string>
#include <vector>

namespace lamplighter {

std::vector<std::string> keyPresetNames();
// The bindings of a preset that differ from the default shortcuts: action text and chords.
const std::vector<std::pair<std::string, std::string>>& keysOfPreset(const std::string& name);

}  // namespace lamplighter
