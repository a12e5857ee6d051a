// The scale of the user interface from the environment variable LAMPLIGHTER_UI_SCALE. It is for
// screens that do not report their density, and for testing the panels at another scale.
#pragma once

#include <optional>
#include <string>

namespace lamplighter {

// Limits of the pixels per design pixel, on all platforms.
inline constexpr float kLeastUiScale = 0.5f, kMostUiScale = 4.0f;

// Parses the text of the variable. Throws InputError if it is not a number within the limits.
float parseUiScale(const std::string& text);
// None: the variable is not set, and the screen decides.
std::optional<float> askedUiScale();

}  // namespace lamplighter
