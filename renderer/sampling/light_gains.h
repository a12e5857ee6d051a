// Converts light samples at the reference brightness of their lights (reference_brightness.h) to
// the brightness of the scene.
#pragma once

#include <map>
#include <vector>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// The gain per channel of each emitter, by the id of its samples with bounce and index 0
// (emitterIds()).
using LightGains = std::map<VplId, vec3>;
LightGains gainsOf(const LightSet& lights);

// 1 for an unknown emitter.
inline vec3 gainOf(const LightGains& gains, const VplId& id) {
  const auto it = gains.find({id.light, id.emitter, 0, 0});
  return it == gains.end() ? vec3(1.0f) : it->second;
}

// Multiplies each VPL by the gain of its light. Removes those that become black.
void applyGains(const LightSet& lights, std::vector<SceneVpl>& vpls);

}  // namespace lamplighter
