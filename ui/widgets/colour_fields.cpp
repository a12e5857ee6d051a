#include "ui/widgets/colour_fields.h"

namespace lamplighter {

bool colourField(const PanelContext& ui, const std::string& widget, const std::string& step,
                 vec3& linear) {
  vec3 shown = linearToSrgb(glm::clamp(linear, 0.0f, 1.0f));
  const std::string id = "##" + widget;
  const bool changed =
      ImGui::ColorEdit3(id.c_str(), &shown.x,
                        ImGuiColorEditFlags_Uint8 | ImGuiColorEditFlags_DisplayRGB |
                            ImGuiColorEditFlags_InputRGB | ImGuiColorEditFlags_PickerHueWheel);
  ui.name(widget);
  trackEdit(ui, step);
  if (changed) linear = srgbToLinear(shown);
  return changed;
}

ColouredStrength split(const vec3& value) {
  ColouredStrength c;
  c.strength = glm::max(value.x, glm::max(value.y, value.z));
  if (c.strength > 0.0f) c.colour = value / c.strength;
  return c;
}

}  // namespace lamplighter
