// Edits of many lights, each one undoable step, or part of the open transaction.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "editor/edits/editing.h"
#include "editor/lights/light_properties.h"

namespace lamplighter {

enum class LightOperation { set, multiply, offset };

// Of the selected lights that have the property. `unit` is that of a set or an offset of
// intensities; those that do not have it are left as they are. Throws InputError when that is all
// of them, or for a value that no light can have.
void editLights(const Editing& editing, LightOperation operation, LightProperty property,
                double value, LightUnit unit);
void colourLights(const Editing& editing, const vec3& colour);

// The state of the selected lights. Throws InputError when none is selected.
void editLightStates(const Editing& editing, const std::string& label,
                     const std::function<void(LightState&)>& change);
// The same of these nodes, selected or not.
void editLightStates(const Editing& editing, const std::vector<NodeId>& nodes,
                     const std::string& label, const std::function<void(LightState&)>& change);
// Puts the selected lights into the group, which is made if there is none of that name; "" takes
// them out. Groups that lose their last light go.
void groupLights(const Editing& editing, const std::string& name);
// Throws InputError when there is no group of that name.
void editLightGroup(const Editing& editing, const std::string& label, const std::string& name,
                    const std::function<void(LightGroup&)>& change);
void editSkyState(const Editing& editing, const std::string& label,
                  const std::function<void(LightState&)>& change);
// Nothing is off, muted or solo any more.
void shineAll(const Editing& editing);

}  // namespace lamplighter
