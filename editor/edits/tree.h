// The tree of nodes as it is edited: what is locked, and hanging nodes below others.
#pragma once

#include <vector>

#include "editor/edits/editing.h"

namespace lamplighter {

// Whether the node or one above it is locked: it is neither picked nor moved in the viewport.
bool isLocked(const Scene& scene, NodeId id);
// Whether it is `above` itself or hangs below it.
bool isWithin(const Scene& scene, NodeId id, NodeId above);

// Nodes, with all below them, below another (kNoNode: at the top), as its last children; places and
// shapes in the world stay. The tree keeps parents before children.
class Reparent final : public Command {
 public:
  // Throws InputError when the parent is one of them or hangs below one, or has no volume.
  Reparent(const Document& document, const std::vector<NodeId>& ids, NodeId parent);
  std::string label() const override { return label_; }
  void apply(Document& document) override { put(document, after_, orderAfter_); }
  void revert(Document& document) override { put(document, before_, orderBefore_); }
  bool absorb(const Command&) override { return false; }
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override;

 private:
  static void put(Document& document, const std::vector<Node>& nodes,
                  const std::vector<NodeId>& order);
  std::string label_;
  std::vector<Node> before_, after_;  // those that hang elsewhere
  std::vector<NodeId> orderBefore_, orderAfter_;
};

void reparent(const Editing& editing, const std::vector<NodeId>& ids, NodeId parent);
void setLocked(const Editing& editing, const std::vector<NodeId>& ids, bool locked);

}  // namespace lamplighter
