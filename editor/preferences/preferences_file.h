// settings.json: the user's preferences as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "editor/preferences/preferences.h"

namespace lamplighter {

// Reads all valid values. Each problem is one line with its place and error; that value keeps its
// default. Never throws for invalid text.
Preferences parsePreferences(std::string_view text, std::vector<std::string>& problems);
std::string preferencesText(const Preferences& preferences);

}  // namespace lamplighter
