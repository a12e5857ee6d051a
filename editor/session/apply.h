// Applies the preferences of the user to a session.
#pragma once

#include <string>
#include <vector>

namespace lamplighter {

class Session;

// Applies keys, units and the tone mapper. Appends problems of the keys to `problems`, one line
// each.
void applyPreferences(Session& session, std::vector<std::string>& problems);
// The budgets and qualities that the program starts with, as no step of the history.
void applyPreset(Session& session);
// What was changed elsewhere, such as by lights.unit, goes into the preferences.
void takePreferences(Session& session);

}  // namespace lamplighter
