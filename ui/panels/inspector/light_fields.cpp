#include <algorithm>
#include <array>

#include "editor/lights/colour_temperature.h"
#include "editor/lights/light_edits.h"
#include "ui/panels/panels.h"
#include "ui/widgets/colour_fields.h"

namespace lamplighter {
namespace {

bool shapeCombo(const PanelContext& ui, AreaLight& light) {
  labelledRow(ui, "Shape", "Shape of the emitting surface.");
  static const std::string kShapes[] = {"Rectangle", "Disk", "Sphere", "Tube"};
  const auto current = static_cast<int>(light.shape);
  const int chosen = combo(ui, "shape", kShapes[current], kShapes);
  if (chosen == kNone || chosen == current) return false;
  light.shape = static_cast<AreaShape>(chosen);
  return true;
}

// Shows the temperature of the nearest black-body colour. An edit sets the colour of another
// temperature and keeps the luminance.
bool temperatureField(const PanelContext& ui, const std::string& step, vec3& emission) {
  const std::optional<float> kelvin = temperatureOf(emission);
  labelledRow(ui, "Temperature",
              "The colour of a black body. Candles 1900 K, warm lamps 2700 K, daylight 6500 K.");
  // Shows the colour of the temperature, even if the light's colour is not near any temperature.
  const float side = ImGui::GetFrameHeight();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  float value = kelvin.value_or(6500.0f);
  const float most = std::max({emission.r, emission.g, emission.b, 1e-6f});
  const vec3 shown = linearToSrgb(glm::clamp(emission / most, 0.0f, 1.0f));
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side},
                                            ImGui::GetColorU32({shown.r, shown.g, shown.b, 1.0f}),
                                            ui.px(3));
  ImGui::Dummy({side, side});
  ImGui::SameLine(0, ui.px(5));
  ImGui::SetNextItemWidth(-FLT_MIN);
  const bool changed = dragField(ui, "temperature", value, 10.0f, kelvin ? "%.0f K" : "\u2013",
                                 kLeastKelvin, kMostKelvin);
  trackEdit(ui, step);
  if (!changed || !(luminance(emission) > 0.0f)) return false;
  emission = withTemperature(emission, value);
  return true;
}

// Shows the strength in the unit of the session, or in the light's own unit if it does not have
// that unit.
bool strengthField(const PanelContext& ui, const std::string& step, const LightMeasure& measure,
                   vec3& emission) {
  const LightUnit wanted = ui.session.lighting().unit;
  const LightUnit unit = unitFor(measure, wanted);
  static constexpr std::array kLabels = {"Flux", "Intensity", "Radiance", "Power", "Illuminance"};
  static constexpr std::array kHelp = {
      "Luminous flux of the whole lamp, in lumens. A bulb gives 600 to 1200 lm.",
      "Luminous intensity in the brightest direction, in candela.",
      "Brightness of the surface, in nits (cd/m\u00b2).",
      "Radiant power of the whole lamp in watts, with 683 lm/W: a tenth or less of its electrical "
      "power.",
      "Illuminance of a surface that faces the light, in lux; the sun gives 100,000 lx."};
  labelledRow(ui, kLabels[static_cast<size_t>(unit)], kHelp[static_cast<size_t>(unit)]);
  const float unitWidth = ui.px(52);
  ImGui::SetNextItemWidth(ImGui::GetContentRegionAvail().x - unitWidth - ui.px(5));
  const auto units = static_cast<float>(unitsPerRadiance(measure, unit));
  const float before = luminance(emission);
  float value = before * units;
  const bool changed =
      dragField(ui, "strength", value, std::max(0.01f, value * 0.01f), "%.4g", 0.0f, 1e9f);
  trackEdit(ui, step);
  if (changed && units > 0.0f) {
    const float strength = std::clamp(value / units, 0.0f, 1e8f);
    // A black light has no colour to keep.
    emission = before > 0.0f ? emission * (strength / before) : vec3(strength);
  }
  ImGui::SameLine(0, ui.px(5));
  const std::string label = std::string(unitSymbol(unit)) + "##unit";
  if (ImGui::Button(label.c_str(), {unitWidth, 0})) {
    // Selects the next unit that this light has.
    constexpr int kUnits = 4;  // only the sun has lux
    for (int i = 1; i <= kUnits; ++i) {
      const auto next = static_cast<LightUnit>((static_cast<int>(wanted) + i) % kUnits);
      if (unitsPerRadiance(measure, next) <= 0.0) continue;
      ui.session.lighting().unit = next;
      break;
    }
  }
  ui.name("unit");
  tooltip(ui, "Unit of the strength of all lights: lumens, candela, nits or watts.");
  return changed;
}

bool emissionFields(const PanelContext& ui, const std::string& step, const LightMeasure& measure,
                    vec3& emission) {
  ColouredStrength coloured = split(emission);
  labelledRow(ui, "Colour", "Linear colour of the light. Its strength stays the same.");
  bool changed = colourField(ui, "colour", step, coloured.colour);
  if (changed) emission = join(coloured);
  changed |= temperatureField(ui, step, emission);
  changed |= strengthField(ui, step, measure, emission);
  return changed;
}

// Whether the light is on, by its own state and by the states of groups and other lights.
void stateFields(const PanelContext& ui, const Node& node) {
  LightState state = node.light;
  labelledRow(ui, "Shines",
              "A light that is off does not emit. While any light is solo, only lights that are "
              "solo emit.");
  bool changed = ImGui::Checkbox("On", &state.on);
  ui.name("on");
  ImGui::SameLine(0, ui.px(14));
  changed |= ImGui::Checkbox("Solo", &state.solo);
  ui.name("solo");
  if (!state.group.empty()) {
    ImGui::SameLine(0, ui.px(14));
    ImGui::TextUnformatted(("in " + state.group).c_str());
  }
  if (changed)
    editLightStates(ui.session.editing(), {node.id}, state.on == node.light.on ? "Solo" : "Switch",
                    [&](LightState& s) { s = state; });
}

}  // namespace

bool fileButtons(const PanelContext& ui, const std::string& what, const std::string& action,
                 const std::string* file, Requests& requests) {
  const float width = ui.px(30);
  const float room =
      file == nullptr ? -FLT_MIN : ImGui::GetContentRegionAvail().x - width - ui.px(5);
  const std::string label = (file == nullptr ? "Choose\u2026" : *file) + "##" + what;
  if (ImGui::Button(label.c_str(), {room, 0})) requests.actions.push_back(action);
  ui.name(what + "/choose");
  if (file == nullptr) return false;
  ImGui::SameLine(0, ui.px(5));
  if (ImGui::Button(("\u00d7##" + what).c_str(), {width, 0}))
    ui.session.runAction(action + " none");
  ui.name(what + "/remove");
  tooltip(ui, "Removes the " + what + ".");
  return true;
}

void areaLightFields(PanelContext ui, const Node& node, Requests& requests) {
  AreaLight light = *node.area;
  const std::string step = "Change light " + node.name;
  stateFields(ui, node);
  bool changed = shapeCombo(ui, light);
  const Scene& scene = ui.session.document().scene;
  const LightMeasure measure = measureOf(scene, node, worldMatrix(scene, node.id));
  changed |= emissionFields(ui, step, measure, light.radiance);

  constexpr float kLeast = 0.001f, kMost = 1000.0f;
  const bool isTube = light.shape == AreaShape::tube;
  if (light.shape == AreaShape::rectangle || isTube) {
    labelledRow(ui, "Size",
                isTube ? "Length and diameter in metres, before the object's scale."
                       : "Width and height in metres, before the object's scale.");
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
  const auto in = [&](LightUnit unit) {
    return short3(nits * unitsPerRadiance(measure, unit)) + " " + unitSymbol(unit);
  };
  note(in(LightUnit::nits) + " \u00b7 " + in(LightUnit::lumens) + " \u00b7 " +
       short3(measure.area) + " m\u00b2");
  if (changed && light != *node.area) ui.session.setAreaLight(node.id, light);
  if (light.shape == AreaShape::rectangle || light.shape == AreaShape::disk || light.picture)
    pictureFields(ui, node, requests);
}

void punctualLightFields(PanelContext ui, const Node& node, Requests& requests) {
  PunctualLight light = *node.punctual;
  const std::string step = "Change light " + node.name;
  stateFields(ui, node);
  const Scene& scene = ui.session.document().scene;
  const LightMeasure measure = measureOf(scene, node, worldMatrix(scene, node.id));
  bool changed = emissionFields(ui, step, measure, light.intensity);
  if (light.kind == PunctualKind::spot) {
    float inner = glm::degrees(light.innerCone), outer = glm::degrees(light.outerCone);
    labelledRow(ui, "Inner cone", "Half angle of the cone of full intensity.");
    bool cone = dragField(ui, "cone.inner", inner, 0.2f, "%.1f\u00b0", 0.0f, 89.0f);
    trackEdit(ui, step);
    labelledRow(ui, "Outer cone", "Half angle at which the intensity reaches zero.");
    cone |= dragField(ui, "cone.outer", outer, 0.2f, "%.1f\u00b0", 0.1f, 90.0f);
    trackEdit(ui, step);
    if (cone) {
      light.outerCone = glm::radians(std::clamp(outer, 0.1f, 90.0f));
      light.innerCone = std::min(glm::radians(std::max(inner, 0.0f)), 0.99f * light.outerCone);
    }
    changed |= cone;
  }
  if (changed && light != *node.punctual) ui.session.setPunctualLight(node.id, light);
  if (light.kind != PunctualKind::directional) profileFields(ui, node, requests);
}

}  // namespace lamplighter
