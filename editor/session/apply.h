// Applies the preferences of the user to a session.
#pragma once

#include <string>
#include <vector>

namespace lamplighter {

class Session;

// Applies keys, units and the tone mapper. Appends problems of the keys to `problems`, one line
// each.
void applyPreferences(Session& session, std::vector<std::string>& problems);
// Sets the initial budgets and quality settings, without a step of the history.
void applyPreset(Session& session);
// Copies values that were changed elsewhere, such as by lights.unit, to the preferences.
void takePreferences(Session& session);

}  // namespace lamplighter
