// How large the user interface is drawn, where the user says so by the environment variable
// LAMPLIGHTER_UI_SCALE: for screens that tell nothing of their density, and to see the panels as
// they are on another screen.
#pragma once

#include <optional>
#include <string>

namespace lamplighter {

// Pixels a design pixel; all platforms keep to these limits.
inline constexpr float kLeastUiScale = 0.5f, kMostUiScale = 4.0f;

// From the variable's text. Throws InputError where that is no number within the limits.
float parseUiScale(const std::string& text);
// None: the variable is not set, so the screen decides.
std::optional<float> askedUiScale();

}  // namespace lamplighter
