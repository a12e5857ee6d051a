#include "editor/lights/light_properties.h"

#include <algorithm>
#include <cmath>

#include "editor/lights/colour_temperature.h"

namespace lamplighter {

namespace {

constexpr double kMostStrength = 1e8;  // of the renderer's units, as in the inspector

// The node as this edit has changed it so far, or else the current node.
Node& nodeIn(LightEdit& edit, const Node& now) {
  const auto it = std::find_if(edit.nodes.begin(), edit.nodes.end(),
                               [&](const Node& n) { return n.id == now.id; });
  return it == edit.nodes.end() ? edit.nodes.emplace_back(now) : *it;
}

// Sets the emission. For a mesh, scales each emissive material once by the change of the mean.
bool setEmission(const Scene& scene, const LightSource& light, const vec3& emission,
                 LightEdit& edit) {
  if (light.node == kNoNode) return false;
  const Node& now = scene.nodes[light.index];
  if (now.area) {
    nodeIn(edit, now).area->radiance = emission;
    return true;
  }
  if (now.punctual) {
    nodeIn(edit, now).punctual->intensity = emission;
    return true;
  }
  const vec3 before = emissionOf(scene, light);
  const float factor = luminance(before) > 0.0f ? luminance(emission) / luminance(before) : 0.0f;
  const bool sameColour = glm::length(emission - factor * before) <= 1e-5f * glm::length(emission);
  const std::vector<int> materials = emissiveMaterials(scene, now);
  for (const int i : materials) {
    const bool done = std::any_of(edit.materials.begin(), edit.materials.end(),
                                  [&](const auto& m) { return m.first == i; });
    if (done) continue;
    Material m = scene.materials[static_cast<size_t>(i)];
    const float strength = luminance(m.emissive) * factor;
    m.emissive = sameColour ? m.emissive * factor
                            : emission * (strength / std::max(luminance(emission), 1e-20f));
    edit.materials.emplace_back(i, std::move(m));
  }
  return !materials.empty();
}

float* sizeOf(AreaLight& light, LightProperty property) {
  const bool isFlat = light.shape == AreaShape::rectangle || light.shape == AreaShape::tube;
  if (property == LightProperty::width) return &light.size.x;
  return isFlat ? &light.size.y : nullptr;
}

}  // namespace

const std::vector<LightPropertyInfo>& lightProperties() {
  static const std::vector<LightPropertyInfo> kProperties = {
      {LightProperty::intensity, "intensity", "Intensity", "", 0.0, 1e14},
      {LightProperty::temperature, "temperature", "Temperature", "K", kLeastKelvin, kMostKelvin},
      {LightProperty::width, "width", "Width, diameter", "m", 0.001, 1000.0},
      {LightProperty::height, "height", "Height", "m", 0.001, 1000.0},
      {LightProperty::innerCone, "inner_cone", "Inner cone", "\u00b0", 0.0, 89.1},
      {LightProperty::outerCone, "outer_cone", "Outer cone", "\u00b0", 0.1, 90.0}};
  return kProperties;
}

const LightPropertyInfo& lightPropertyInfo(LightProperty property) {
  return lightProperties()[static_cast<size_t>(property)];
}

std::optional<double> valueOf(const Scene& scene, const LightSource& light, LightProperty property,
                              LightUnit unit) {
  if (property == LightProperty::intensity) {
    const double units = unitsPerRadiance(light.measure, unitFor(light.measure, unit));
    return units * static_cast<double>(luminance(emissionOf(scene, light)));
  }
  if (light.node == kNoNode) return std::nullopt;
  const Node& node = scene.nodes[light.index];
  switch (property) {
    case LightProperty::temperature: {
      const auto kelvin = temperatureOf(emissionOf(scene, light));
      return kelvin ? std::optional<double>(*kelvin) : std::nullopt;
    }
    case LightProperty::width:
    case LightProperty::height: {
      if (!node.area) return std::nullopt;
      AreaLight area = *node.area;
      const float* size = sizeOf(area, property);
      return size ? std::optional<double>(*size) : std::nullopt;
    }
    case LightProperty::innerCone:
    case LightProperty::outerCone:
      if (light.measure.kind != LightKind::spot) return std::nullopt;
      return glm::degrees(static_cast<double>(property == LightProperty::innerCone
                                                  ? node.punctual->innerCone
                                                  : node.punctual->outerCone));
    case LightProperty::intensity:
      break;
  }
  return std::nullopt;
}

CommonValue commonValue(const Scene& scene, const std::vector<LightSource>& lights,
                        LightProperty property, LightUnit unit) {
  CommonValue out;
  for (const LightSource& light : lights) {
    const auto value = valueOf(scene, light, property, unit);
    if (!value) continue;
    const LightUnit own = unitFor(light.measure, unit);
    if (out.count++ == 0) {
      out.least = out.most = *value;
      out.unit = own;
    }
    out.hasMixedUnits |= property == LightProperty::intensity && own != out.unit;
    out.least = std::min(out.least, *value);
    out.most = std::max(out.most, *value);
  }
  // Temperatures are computed from colours, so they are accurate to one kelvin.
  const double same = property == LightProperty::temperature ? 1.0 : 1e-6 * std::abs(out.most);
  out.isMixed = out.most - out.least > same || out.hasMixedUnits;
  return out;
}

bool setValue(const Scene& scene, const LightSource& light, LightProperty property, LightUnit unit,
              double value, LightEdit& edit) {
  if (light.node == kNoNode) return false;
  const LightPropertyInfo& info = lightPropertyInfo(property);
  const auto clamped = static_cast<float>(std::clamp(value, info.least, info.most));
  const Node& now = scene.nodes[light.index];
  switch (property) {
    case LightProperty::intensity: {
      const double units = unitsPerRadiance(light.measure, unit);
      if (!(units > 0.0)) return false;
      const auto strength = static_cast<float>(std::clamp(value / units, 0.0, kMostStrength));
      const vec3 before = emissionOf(scene, light);
      const float was = luminance(before);
      // A black light has no colour to keep.
      return setEmission(scene, light, was > 0.0f ? before * (strength / was) : vec3(strength),
                         edit);
    }
    case LightProperty::temperature:
      return setEmission(scene, light, withTemperature(emissionOf(scene, light), clamped), edit);
    case LightProperty::width:
    case LightProperty::height: {
      if (!now.area) return false;
      AreaLight area = *now.area;
      float* size = sizeOf(area, property);
      if (size == nullptr) return false;
      *size = clamped;
      if (sizeOf(area, LightProperty::height) == nullptr) area.size.y = area.size.x;
      nodeIn(edit, now).area = area;
      return true;
    }
    case LightProperty::innerCone:
    case LightProperty::outerCone: {
      if (light.measure.kind != LightKind::spot) return false;
      PunctualLight& spot = *nodeIn(edit, now).punctual;
      (property == LightProperty::innerCone ? spot.innerCone : spot.outerCone) =
          glm::radians(clamped);
      spot.innerCone = std::min(spot.innerCone, 0.99f * spot.outerCone);
      return true;
    }
  }
  return false;
}

bool setColour(const Scene& scene, const LightSource& light, const vec3& colour, LightEdit& edit) {
  const float strength = luminance(emissionOf(scene, light));
  if (!(luminance(colour) > 0.0f)) return false;
  return setEmission(scene, light, colour * (strength / luminance(colour)), edit);
}

}  // namespace lamplighter
