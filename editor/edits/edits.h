// Functions for copying nodes, and for queries of the tree of nodes.
#pragma once

#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// For each node of the scene, whether it is one of `ids` or a descendant of one.
std::vector<bool> withDescendants(const Scene& scene, const std::vector<NodeId>& ids);

// Copies of nodes and all their descendants, with the same parents and new ids.
struct Copies {
  std::vector<Node> nodes;    // parents before children
  std::vector<NodeId> roots;  // the copies of the topmost of `ids`
};
Copies copyNodes(Editing& editing, const std::vector<NodeId>& ids);

// Throws InputError if the level would have more than 20,000 objects after adding `more`.
void requireRoomFor(const Scene& scene, size_t more);

// `ids` without descendants of other ones, in the order of Scene::nodes.
std::vector<NodeId> topmost(const Scene& scene, const std::vector<NodeId>& ids);

// Each of these is one step, or joins the open one.
void setNodes(Editing& editing, const std::string& label, std::vector<Node> nodes);
void addNodes(Editing& editing, const std::string& label, std::vector<Node> nodes);

}  // namespace lamplighter
