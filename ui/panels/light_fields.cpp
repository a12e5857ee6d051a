#include <algorithm>
#include <array>

#include "ui/panels/colour_fields.h"
#include "ui/panels/panels.h"

namespace lamplighter {
namespace {

constexpr std::array kShapeNames = {"Rectangle", "Disk", "Sphere"};

// Emitting area [m²], with the scale of the node's place in the world along its own axes. Exact
// where the scale is equal on the axes that the shape has, else a disk is taken as an ellipse and a
// sphere by its mean radius.
float areaOf(const Scene& scene, const Node& node, const AreaLight& light) {
  const mat4 world = worldMatrix(scene, node.id);
  const vec3 x(world[0]), y(world[1]), z(world[2]);
  switch (light.shape) {
    case AreaShape::rectangle:
      return glm::length(glm::cross(x, y)) * light.size.x * light.size.y;
    case AreaShape::disk:
      return glm::length(glm::cross(x, y)) * kPi * 0.25f * light.size.x * light.size.x;
    case AreaShape::sphere: {
      const float diameter =
          light.size.x * (glm::length(x) + glm::length(y) + glm::length(z)) / 3.0f;
      return kPi * diameter * diameter;
    }
  }
  return 0.0f;
}

bool shapeCombo(const PanelContext& ui, AreaLight& light) {
  labelledRow(ui, "Shape");
  const auto current = static_cast<size_t>(light.shape);
  bool changed = false;
  const bool open = ImGui::BeginCombo("##shape", kShapeNames[current]);
  ui.name("shape");
  if (!open) return false;
  for (size_t i = 0; i < kShapeNames.size(); ++i) {
    if (ImGui::Selectable(kShapeNames[i], i == current) && i != current) {
      light.shape = static_cast<AreaShape>(i);
      changed = true;
    }
    ui.name(std::string("shape/") + kShapeNames[i]);
  }
  ImGui::EndCombo();
  return changed;
}

// Strength as nits or as the lumens of the whole lamp: Φ = π·L·A of a Lambertian emitter.
bool strengthField(const PanelContext& ui, const std::string& step, float area,
                   ColouredStrength& light, InspectorState& state) {
  const float lumensOfUnit = kPi * area * luminance(light.colour);
  const bool byFlux = state.lumens && lumensOfUnit > 0.0f;
  labelledRow(ui, byFlux ? "Flux" : "Radiance",
              byFlux ? "Light of the whole lamp. A bulb gives 600 to 1200 lm."
                     : "Brightness of the surface, in nits (cd/m\u00b2).");
  const float unitWidth = ui.px(52);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - unitWidth - ui.px(5));
  float value = byFlux ? light.strength * lumensOfUnit : light.strength;
  const bool changed =
      dragField(ui, "strength", value, std::max(0.01f, value * 0.01f), "%.4g", 0.0f, 1e8f);
  trackEdit(ui, step);
  if (changed) light.strength = byFlux ? value / lumensOfUnit : value;
  ImGui::SameLine(0, ui.px(5));
  if (ImGui::Button(byFlux ? "lm##unit" : "nt##unit", {unitWidth, 0})) state.lumens = !state.lumens;
  ui.name("unit");
  tooltip(ui, "Switch between nits and lumens.");
  return changed;
}

}  // namespace

void areaLightFields(PanelContext ui, const Node& node, InspectorState& state) {
  AreaLight light = *node.area;
  const std::string step = "Change light " + node.name;
  bool changed = shapeCombo(ui, light);

  const float area = areaOf(ui.session.document().scene, node, light);
  ColouredStrength radiance = split(light.radiance);
  labelledRow(ui, "Colour");
  bool lit = colourField(ui, "colour", step, radiance.colour);
  lit |= strengthField(ui, step, area, radiance, state);
  if (lit) light.radiance = join(radiance);
  changed |= lit;

  constexpr float kLeast = 0.001f, kMost = 1000.0f;
  if (light.shape == AreaShape::rectangle) {
    labelledRow(ui, "Size", "Width and height in metres, before the object's scale.");
    const float gap = ui.px(5);
    const float width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    ImGui::SetNextItemWidth(width);
    changed |= dragField(ui, "size.x", light.size.x, 0.01f, "%.3f m", kLeast, kMost);
    trackEdit(ui, step);
    ImGui::SameLine(0, gap);
    ImGui::SetNextItemWidth(-FLT_MIN);
    changed |= dragField(ui, "size.y", light.size.y, 0.01f, "%.3f m", kLeast, kMost);
    trackEdit(ui, step);
  } else {
    labelledRow(ui, "Diameter", "In metres, before the object's scale.");
    changed |= dragField(ui, "size.x", light.size.x, 0.01f, "%.3f m", kLeast, kMost);
    trackEdit(ui, step);
  }
  light.size = glm::clamp(light.size, kLeast, kMost);
  const double nits = luminance(light.radiance);
  note(short3(nits) + " nt \u00b7 " + short3(nits * kPi * area) + " lm \u00b7 " + short3(area) +
       " m\u00b2");
  if (changed && light != *node.area) ui.session.setAreaLight(node.id, light);
}

void punctualLightFields(PanelContext ui, const Node& node) {
  PunctualLight light = *node.punctual;
  const std::string step = "Change light " + node.name;
  const bool directional = light.kind == PunctualKind::directional;
  ColouredStrength intensity = split(light.intensity);
  labelledRow(ui, "Colour");
  bool changed = colourField(ui, "colour", step, intensity.colour);
  labelledRow(ui, directional ? "Illuminance" : "Intensity",
              directional ? "On a surface that faces the light; the sun gives 100,000 lx."
                          : "Light in each direction, in candela.");
  changed |=
      dragField(ui, "strength", intensity.strength, std::max(0.01f, intensity.strength * 0.01f),
                directional ? "%.4g lx" : "%.4g cd", 0.0f, 1e8f);
  trackEdit(ui, step);
  light.intensity = join(intensity);
  if (light.kind == PunctualKind::spot) {
    float inner = glm::degrees(light.innerCone), outer = glm::degrees(light.outerCone);
    labelledRow(ui, "Inner cone", "Half the angle within which the light is full.");
    bool cone = dragField(ui, "cone.inner", inner, 0.2f, "%.1f\u00b0", 0.0f, 89.0f);
    trackEdit(ui, step);
    labelledRow(ui, "Outer cone", "Half the angle at which the light ends.");
    cone |= dragField(ui, "cone.outer", outer, 0.2f, "%.1f\u00b0", 0.1f, 90.0f);
    trackEdit(ui, step);
    if (cone) {
      light.outerCone = glm::radians(std::clamp(outer, 0.1f, 90.0f));
      light.innerCone = std::min(glm::radians(std::max(inner, 0.0f)), 0.99f * light.outerCone);
    }
    changed |= cone;
  }
  if (changed && light != *node.punctual) ui.session.setPunctualLight(node.id, light);
}

}  // namespace lamplighter
