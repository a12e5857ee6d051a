// Edits of several lights. Each is one undo step, or part of the open transaction.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "editor/edits/editing.h"
#include "editor/lights/light_properties.h"

namespace lamplighter {

enum class LightOperation { set, multiply, offset };

// Edits the selected lights that have the property; the others stay unchanged. `unit` applies to
// intensities that are set or offset. Throws InputError if no selected light has the property, or
// if the value is invalid.
void editLights(Editing& editing, LightOperation operation, LightProperty property, double value,
                LightUnit unit);
void colourLights(Editing& editing, const vec3& colour);

// Edits the states of the selected lights. Throws InputError if no light is selected.
void editLightStates(Editing& editing, const std::string& label,
                     const std::function<void(LightState&)>& change);
// Edits the states of these nodes, selected or not.
void editLightStates(Editing& editing, const std::vector<NodeId>& nodes, const std::string& label,
                     const std::function<void(LightState&)>& change);
// Adds the selected lights to the group and creates it if it does not exist. "" removes them from
// their groups. Empty groups are deleted.
void groupLights(Editing& editing, const std::string& name);
// Throws InputError if the group does not exist.
void editLightGroup(Editing& editing, const std::string& label, const std::string& name,
                    const std::function<void(LightGroup&)>& change);
void editSkyState(Editing& editing, const std::string& label,
                  const std::function<void(LightState&)>& change);
// Clears the off, mute and solo states of all lights.
void shineAll(Editing& editing);

}  // namespace lamplighter
