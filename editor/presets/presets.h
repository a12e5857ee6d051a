// Presets of quality for all methods: draft for fast feedback, work for editing, final for results.
// They do not change bounces, frame time and exposure.
#pragma once

#include <string>
#include <vector>

#include "editor/document/document.h"

namespace lamplighter {

struct Preset {
  std::string name;  // "draft"
  std::string label, help;
  Settings values;  // every preset sets the same parameters
};

// draft, work, final.
const std::vector<Preset>& presets();
// The settings with the values of the preset. Method, exposure and all other settings stay
// unchanged. Values equal to a parameter's default are left unset.
RenderSettings withPreset(const RenderSettings& settings, const Preset& preset);
bool hasPreset(const RenderSettings& settings, const Preset& preset);

}  // namespace lamplighter
