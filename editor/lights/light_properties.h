// Properties that can be set for several lights at once, each as one number.
#pragma once

#include <optional>
#include <vector>

#include "editor/lights/light_list.h"

namespace lamplighter {

enum class LightProperty { intensity, temperature, width, height, innerCone, outerCone };

struct LightPropertyInfo {
  LightProperty property;
  const char* name;   // in actions
  const char* label;  // in the panel
  const char* unit;   // displayed unit; intensity has its own units
  double least, most;
};
const std::vector<LightPropertyInfo>& lightProperties();
const LightPropertyInfo& lightPropertyInfo(LightProperty property);

// The value in metres, degrees or kelvin. Intensity is in `unit`, or in the replacement that
// unitFor() gives. None if the light does not have the property: a disk has no height, a green
// light no temperature.
std::optional<double> valueOf(const Scene& scene, const LightSource& light, LightProperty property,
                              LightUnit unit);

// The values of several lights, as one field shows them.
struct CommonValue {
  int count = 0;         // number of lights that have the property
  bool isMixed = false;  // their values differ in the first six digits
  double least = 0.0, most = 0.0;
  LightUnit unit = LightUnit::lumens;  // intensity: unit of the first light
  bool hasMixedUnits = false;          // intensity: the lights have different units
  // The unit of an intensity that the user types: the common unit of all lights, or else `wanted`.
  LightUnit unitOr(LightUnit wanted) const { return count > 0 && !hasMixedUnits ? unit : wanted; }
};
CommonValue commonValue(const Scene& scene, const std::vector<LightSource>& lights,
                        LightProperty property, LightUnit unit);

// A light with the property set to a value: its node and, for meshes, its materials. False if the
// light does not have the property. Values are clamped to the valid range.
struct LightEdit {
  std::vector<Node> nodes;
  std::vector<std::pair<int, Material>> materials;
};
bool setValue(const Scene& scene, const LightSource& light, LightProperty property, LightUnit unit,
              double value, LightEdit& edit);
// Sets the colour and keeps the luminance.
bool setColour(const Scene& scene, const LightSource& light, const vec3& colour, LightEdit& edit);

}  // namespace lamplighter
