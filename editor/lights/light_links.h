// Edits of light linking: which objects a light excludes (renderer/scene/light_linking.h).
#pragma once

#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// The selected nodes that are not lights.
std::vector<NodeId> selectedObjects(const Document& document);
// The existing objects that any selected light excludes directly, not through a parent.
std::vector<NodeId> leftOutBySelection(const Document& document);

// Makes these lights (kNoNode: the sky) exclude these objects, or include them again. One undo
// step. Throws InputError if there are no lights or no objects, if a light would exclude only
// itself, or if the scene would have more than kMostLinks different lists.
void leaveOut(Editing& editing, const std::vector<NodeId>& lights,
              const std::vector<NodeId>& objects, bool out);

}  // namespace lamplighter
