// Fields for colours, and for light as a colour with a strength.
#pragma once

#include <string>

#include "ui/widgets/widgets.h"

namespace lamplighter {

// A swatch with a colour picker for a reflectance in [0, 1]. Input and output are linear. Returns
// true if it changed.
bool colourField(const PanelContext& ui, const std::string& widget, const std::string& step,
                 vec3& linear);

// Light as a colour with its brightest channel at 1 and a strength: value = colour × strength.
struct ColouredStrength {
  vec3 colour{1.0f};
  float strength = 0.0f;
};
ColouredStrength split(const vec3& value);
inline vec3 join(const ColouredStrength& c) { return c.colour * c.strength; }

}  // namespace lamplighter
