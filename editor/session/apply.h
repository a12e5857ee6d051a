// Between preferences and what the session goes by.
#pragma once

#include <string>
#include <vector>

namespace lamplighter {

class Session;

// Keys, units, tone mapper. Problems of the keys, one line each.
void applyPreferences(Session& session, std::vector<std::string>& problems);
// The budgets and qualities that the program starts with, as no step of the history.
void applyPreset(Session& session);
// What was changed elsewhere, such as by lights.unit, goes into the preferences.
void takePreferences(Session& session);

}  // namespace lamplighter
