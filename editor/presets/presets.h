// Sets of values for the budgets and qualities of all methods at once: quick to look at, to work
// with, to keep.
#pragma once

#include <string>
#include <vector>

#include "editor/document/document.h"

namespace lamplighter {

struct Preset {
  std::string name;  // "draft"
  std::string label, help;
  Settings values;  // all of what presets set; the same parameters in each
};

// draft, work, final.
const std::vector<Preset>& presets();
// The settings with the preset's values; method, exposure and all else as they are. What is a
// parameter's default is left unset.
RenderSettings withPreset(const RenderSettings& settings, const Preset& preset);
bool hasPreset(const RenderSettings& settings, const Preset& preset);

}  // namespace lamplighter
