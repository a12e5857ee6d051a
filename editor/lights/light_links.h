// Which objects lights leave out, as it is edited (renderer/scene/light_linking.h).
#pragma once

#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// Of what is selected, what is no light.
std::vector<NodeId> selectedObjects(const Document& document);
// What any of the selected lights leaves out and is there, by itself and not through a parent.
std::vector<NodeId> leftOutBySelection(const Document& document);

// From now on these lights (kNoNode: the sky) leave these objects out, or do so no more. One step.
// Throws InputError when there are no lights or no objects, for a light that would leave out itself
// alone, and when the scene would have more lists that differ than it can (kMostLinks).
void leaveOut(const Editing& editing, const std::vector<NodeId>& lights,
              const std::vector<NodeId>& objects, bool out);

}  // namespace lamplighter
