// The profile of a point or spot light: its file and a plot.
#include <cmath>

#include <imgui.h>

#include "renderer/scene/ies/ies_profile.h"
#include "ui/panels/panels.h"
#include "ui/widgets/theme.h"

namespace lamplighter {
namespace {

constexpr int kSteps = 90;

// Plots intensity over the angle from the nadir in two planes, each to both sides, like the curves
// in luminaire catalogues.
void polarPlot(const PanelContext& ui, const IesProfile& profile) {
  const float side = std::min(ImGui::GetContentRegionAvail().x, ui.px(200));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  ImGui::Dummy({side, side});
  ui.name("profile/plot");
  tooltip(ui,
          "Intensity over the angle from the axis of the light, which points down here. Bright "
          "curve: the plane of the X axis of the light; dim curve: of its Y axis.");
  const vec2 centre(corner.x + 0.5f * side, corner.y + 0.5f * side);
  const float radius = 0.48f * side;
  ImDrawList& draw = *ImGui::GetWindowDrawList();
  draw.AddRectFilled(corner, {corner.x + side, corner.y + side}, theme::colour(theme::kBackground),
                     ui.px(4));
  const ImU32 line = theme::colour(theme::kLine);
  for (const float ring : {0.25f, 0.5f, 0.75f, 1.0f})
    draw.AddCircle({centre.x, centre.y}, ring * radius, line, 64);
  for (int spoke = 0; spoke < 6; ++spoke) {
    const float a = kPi * static_cast<float>(spoke) / 6.0f;
    const vec2 d = radius * vec2(std::cos(a), std::sin(a));
    draw.AddLine({centre.x - d.x, centre.y - d.y}, {centre.x + d.x, centre.y + d.y}, line);
  }
  const auto curve = [&](const vec3& across, ImU32 colour) {
    for (int i = 0; i <= 2 * kSteps; ++i) {
      const float angle = kPi * (static_cast<float>(i) / kSteps - 1.0f);
      const float s = std::sin(angle), c = std::cos(angle);
      const float value = profile.at(s * across - vec3(0, 0, c));
      draw.PathLineTo({centre.x + radius * value * s, centre.y + radius * value * c});
    }
    draw.PathStroke(colour, 0, ui.px(2));
  };
  curve(vec3(0, 1, 0), theme::colour(theme::kAccent, 110));
  curve(vec3(1, 0, 0), theme::colour(theme::kAccent));
}

}  // namespace

void profileFields(const PanelContext& ui, const Node& node, Requests& requests) {
  const auto profile = node.punctual->profile;
  labelledRow(ui, "Profile",
              "Angular distribution of the luminaire's intensity: an IES file (LM-63).");
  if (!fileButtons(ui, "profile", "light.ies", profile ? &profile->file : nullptr, requests))
    return;
  polarPlot(ui, *profile);
  const float measured = profile->peak * profile->solidAngle;
  if (ImGui::Button("As measured", {-FLT_MIN, 0})) {
    PunctualLight light = *node.punctual;
    const float was = luminance(light.intensity);
    light.intensity = was > 0.0f ? light.intensity * (profile->peak / was) : vec3(profile->peak);
    ui.session.setPunctualLight(node.id, light);
  }
  ui.name("profile/measured");
  tooltip(ui, "Sets the light's intensity to the candela values of the file.");
  note(std::string(profile->isTypeB ? "Type B" : "Type C") + " \u00b7 " +
       short3(static_cast<double>(profile->peak)) + " cd \u00b7 " +
       short3(static_cast<double>(measured)) + " lm as measured");
  if (profile->tiltAngles.empty()) return;
  const mat4 world = worldMatrix(ui.session.document().scene, node.id);
  const vec3 aim = mat3(world) * vec3(0, 0, -1);
  const float length = glm::length(aim);
  if (length > 0.0f)
    note("With its present tilt the lamp gives " +
         short3(100.0 * static_cast<double>(profile->atTilt(aim / length))) + "% of its light.");
}

}  // namespace lamplighter
