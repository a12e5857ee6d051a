// Edits of the tree of nodes: parents and locks.
#pragma once

#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// Whether the node or a node above it is locked, so that it cannot be picked or moved in the
// viewport.
bool isLocked(const Scene& scene, NodeId id);
// Whether the node is `above` or a descendant of it.
bool isWithin(const Scene& scene, NodeId id, NodeId above);

// Moves nodes, with all their descendants, to another parent (kNoNode: to the top), as its last
// children. They keep their world transform. Throws InputError if the parent is one of them or a
// descendant of one, or if its transform has no volume.
void reparent(Editing& editing, const std::vector<NodeId>& ids, NodeId parent);
void setLocked(Editing& editing, const std::vector<NodeId>& ids, bool locked);

}  // namespace lamplighter
