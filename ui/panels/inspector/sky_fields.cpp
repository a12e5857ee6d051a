#include "ui/panels/panels.h"
#include "ui/widgets/colour_fields.h"

namespace lamplighter {
namespace {

constexpr float kMostRadiance = 1e6f;

// A colour and its strength. Returns true if it changed.
bool radianceFields(const PanelContext& ui, const char* label, const std::string& widget,
                    const char* help, vec3& radiance) {
  const std::string step = std::string("Change ") + label + " of the sky";
  ColouredStrength light = split(radiance);
  labelledRow(ui, label, help);
  bool changed = colourField(ui, widget + ".colour", step, light.colour);
  labelledRow(ui, "", help);
  changed |= dragField(ui, widget + ".strength", light.strength,
                       std::max(0.01f, light.strength * 0.01f), "%.4g nt", 0.0f, kMostRadiance);
  trackEdit(ui, step);
  if (changed) radiance = join(light);
  return changed;
}

// Converts the sky to the other kind and keeps its look as far as possible.
Sky asConstant(const Sky& sky) {
  if (sky.kind == SkyKind::gradient) return Sky(sky.horizon);
  return sky.isBlack() || sky.kind == SkyKind::image ? Sky(kDefaultSky) : sky;
}

Sky asGradient(const Sky& sky) {
  const vec3 base = asConstant(sky).radiance;
  return Sky::gradient(base * vec3(0.35f, 0.6f, 1.0f), base, base * vec3(0.22f, 0.2f, 0.18f));
}

void kindField(const PanelContext& ui, const Sky& sky, Requests& requests) {
  static const ComboItem kKinds[] = {
      {"none", "None"}, {"constant", "Colour"}, {"gradient", "Gradient"}, {"image", "Picture"}};
  const int current =
      sky.isBlack() && sky.kind == SkyKind::constant ? 0 : static_cast<int>(sky.kind) + 1;
  labelledRow(ui, "Kind",
              "The environment, which lights the scene from all directions. It uses a part of the "
              "light samples.");
  const int chosen = combo(ui, "kind", kKinds[current].label, kKinds, current);
  if (chosen == current) return;
  if (chosen == 0) ui.session.setSky(Sky());
  if (chosen == 1) ui.session.setSky(asConstant(sky));
  if (chosen == 2) ui.session.setSky(asGradient(sky));
  if (chosen == 3)
    requests.actions.emplace_back("sky.image");  // becomes a picture sky when a file is chosen
}

bool pictureFields(const PanelContext& ui, Sky& sky, Requests& requests) {
  labelledRow(ui, "File", "An equirectangular picture: EXR, HDR, or any other.");
  if (ImGui::Button((sky.image->name + "##file").c_str(), {-FLT_MIN, 0}))
    requests.actions.emplace_back("sky.image");
  ui.name("file");
  float degrees = glm::degrees(sky.rotation);
  labelledRow(ui, "Rotation", "About the vertical axis, counter-clockwise seen from above.");
  bool changed = dragField(ui, "rotation", degrees, 0.5f, "%.1f\u00b0", -360.0f, 360.0f);
  trackEdit(ui, "Turn the sky");
  if (changed) sky.rotation = glm::radians(degrees);
  labelledRow(ui, "Scale", "Multiplies the picture's radiance.");
  changed |= dragField(ui, "scale", sky.scale, std::max(0.001f, sky.scale * 0.01f), "%.4g", 0.0f,
                       kMostRadiance);
  trackEdit(ui, "Scale the sky");
  const Image& pixels = sky.image->pixels;
  const size_t suns = sky.image->map.suns().size();
  note(std::to_string(pixels.width) + " \u00d7 " + std::to_string(pixels.height) +
       (suns == 0   ? ""
        : suns == 1 ? " \u00b7 1 sun"
                    : " \u00b7 " + std::to_string(suns) + " suns"));
  return changed;
}

void stateField(const PanelContext& ui) {
  LightState state = ui.session.document().scene.skyLight;
  labelledRow(ui, "Shines",
              "A light that is off does not emit. While any light is solo, only lights that are "
              "solo emit.");
  if (ImGui::Checkbox("On", &state.on))
    ui.session.runAction(state.on ? "sky.on true" : "sky.on false");
  ui.name("on");
  ImGui::SameLine(0, ui.px(14));
  if (ImGui::Checkbox("Solo", &state.solo))
    ui.session.runAction(state.solo ? "sky.solo true" : "sky.solo false");
  ui.name("solo");
}

}  // namespace

void skyFields(PanelContext ui, InspectorState& state, Requests& requests) {
  ui.prefix = "sky/";
  Sky sky = ui.session.document().scene.sky;
  kindField(ui, sky, requests);
  if (!(sky == ui.session.document().scene.sky)) return;  // shown from the next frame on
  if (!sky.isBlack()) stateField(ui);
  bool changed = false;
  switch (sky.kind) {
    case SkyKind::constant:
      if (!sky.isBlack())
        changed = radianceFields(ui, "Colour", "constant", "The same radiance from all directions.",
                                 sky.radiance);
      break;
    case SkyKind::gradient:
      changed = radianceFields(ui, "Zenith", "zenith", "Straight above.", sky.zenith);
      changed |= radianceFields(ui, "Horizon", "horizon", "At the horizon.", sky.horizon);
      changed |=
          radianceFields(ui, "Ground", "ground", "Everywhere below the horizon.", sky.ground);
      break;
    case SkyKind::image:
      changed = pictureFields(ui, sky, requests);
      break;
  }
  if (changed) ui.session.setSky(sky);
  if (!sky.isBlack()) linkFields(ui, kNoNode, state);
  if (ui.session.document().scene.skyIsDefault)
    note("A default sky, because the level has no light. It is not saved until it is changed.");
}

}  // namespace lamplighter
