// Sets of keys for the tools that are used most: after the row of the keyboard (W E R) or after the
// words (G R S, grab, rotate, scale).
#pragma once

#include <string>
#include <vector>

namespace lamplighter {

std::vector<std::string> keyPresetNames();
// What a preset binds otherwise than the actions' own shortcuts: action text and chords.
const std::vector<std::pair<std::string, std::string>>& keysOfPreset(const std::string& name);

}  // namespace lamplighter
