// Fields for colours and for light: a colour and how much of it.
#pragma once

#include <string>

#include "ui/panels/widgets.h"

namespace lamplighter {

// A swatch with a picker for a reflectance in [0, 1], linear in and out. True when it changed.
bool colourField(const PanelContext& ui, const std::string& widget, const std::string& step,
                 vec3& linear);

// Light as a colour of full brightness and a strength: value = colour × strength.
struct ColouredStrength {
  vec3 colour{1.0f};
  float strength = 0.0f;
};
ColouredStrength split(const vec3& value);
inline vec3 join(const ColouredStrength& c) { return c.colour * c.strength; }

// Luminance of linear Rec.709.
inline float luminance(const vec3& c) { return glm::dot(c, vec3(0.2126f, 0.7152f, 0.0722f)); }

}  // namespace lamplighter
