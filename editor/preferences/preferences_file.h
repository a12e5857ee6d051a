// settings.json: the user's preferences as text.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "editor/preferences/preferences.h"

namespace lamplighter {

// Takes what is sound; each problem is one line that says where and what is wrong, and leaves its
// default. Never throws for a bad text.
Preferences parsePreferences(std::string_view text, std::vector<std::string>& problems);
std::string preferencesText(const Preferences& preferences);

}  // namespace lamplighter
