// What can be set for many lights at once, as one number each.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "editor/lights/light_list.h"

namespace lamplighter {

enum class LightProperty { intensity, temperature, width, height, innerCone, outerCone };

struct LightPropertyInfo {
  LightProperty property;
  const char* name;   // in actions
  const char* label;  // in the panel
  const char* unit;   // as shown; intensity has units of its own
  double least, most;
};
const std::vector<LightPropertyInfo>& lightProperties();
const LightPropertyInfo& lightPropertyInfo(LightProperty property);

// In metres, degrees, kelvin; intensity in `unit`, or in the one unitFor() gives instead. None
// where the light has no such property: a disk has no height, a green light no temperature.
std::optional<double> valueOf(const Scene& scene, const LightSource& light, LightProperty property,
                              LightUnit unit);

// The values of many lights as one field shows them.
struct CommonValue {
  int count = 0;         // lights that have it
  bool isMixed = false;  // and not all the same, to six digits
  double least = 0.0, most = 0.0;
  LightUnit unit = LightUnit::lumens;  // intensity: that of the first
  bool hasMixedUnits = false;          // intensity: some have another
  // In which an intensity is to be typed: the one that all have, or the one that was asked for.
  LightUnit unitOr(LightUnit wanted) const { return count > 0 && !hasMixedUnits ? unit : wanted; }
};
CommonValue commonValue(const Scene& scene, const std::vector<LightSource>& lights,
                        LightProperty property, LightUnit unit);

// The light with the property at a value, as a node and, for meshes, materials. False where it has
// no such property. Values are clamped to those that it can have.
struct LightEdit {
  std::vector<Node> nodes;
  std::vector<std::pair<int, Material>> materials;
};
bool setValue(const Scene& scene, const LightSource& light, LightProperty property, LightUnit unit,
              double value, LightEdit& edit);
// The same for its colour, whose luminance stays.
bool setColour(const Scene& scene, const LightSource& light, const vec3& colour, LightEdit& edit);

}  // namespace lamplighter
