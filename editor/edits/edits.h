// The commands there are. Each keeps what it changes as values before and after.
#pragma once

#include <utility>
#include <vector>

#include "editor/edits/command.h"

namespace lamplighter {

// Other values for nodes that stay: transform, light, name, visibility. The ids of `after` say
// which; nodes that are not there are left out.
// What they take in memory, about, with all that they share.
size_t bytesOf(const std::vector<Node>& nodes);

class EditNodes final : public Command {
 public:
  EditNodes(std::string label, const Document& document, std::vector<Node> after);
  std::string label() const override { return label_; }
  void apply(Document& document) override { put(document, after_); }
  void revert(Document& document) override { put(document, before_); }
  bool absorb(const Command& later) override;
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override;

 private:
  static void put(Document& document, const std::vector<Node>& nodes);
  std::string label_;
  std::vector<Node> before_, after_;  // the same ids in the same order
};

class EditMaterial final : public Command {
 public:
  EditMaterial(const Document& document, int index, Material after);
  std::string label() const override;
  void apply(Document& document) override {
    document.scene.materials[static_cast<size_t>(index_)] = after_;
  }
  void revert(Document& document) override {
    document.scene.materials[static_cast<size_t>(index_)] = before_;
  }
  bool absorb(const Command& later) override;
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override { return sizeof *this; }

 private:
  int index_;
  Material before_, after_;
};

class EditRender final : public Command {
 public:
  EditRender(const Document& document, RenderSettings after);
  std::string label() const override { return "Change render settings"; }
  void apply(Document& document) override { document.render = after_; }
  void revert(Document& document) override { document.render = before_; }
  bool absorb(const Command& later) override;
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override;

 private:
  RenderSettings before_, after_;
};

// Another sky. It is the user's then, and no longer the one that a scene without light is given.
class EditSky final : public Command {
 public:
  EditSky(const Document& document, Sky after)
      : before_(document.scene.sky),
        after_(std::move(after)),
        wasDefault_(document.scene.skyIsDefault) {}
  std::string label() const override { return "Change the sky"; }
  void apply(Document& document) override { put(document, after_, false); }
  void revert(Document& document) override { put(document, before_, wasDefault_); }
  bool absorb(const Command& later) override;
  bool changesNothing() const override { return before_ == after_; }
  size_t bytes() const override;

 private:
  static void put(Document& document, const Sky& sky, bool isDefault) {
    document.scene.sky = sky;
    document.scene.skyIsDefault = isDefault;
  }
  Sky before_, after_;
  bool wasDefault_;
};

// New nodes at the end, parents before children, with ids that Scene::nextId has given out.
class AddNodes final : public Command {
 public:
  AddNodes(std::string label, std::vector<Node> nodes)
      : label_(std::move(label)), nodes_(std::move(nodes)) {}
  std::string label() const override { return label_; }
  void apply(Document& document) override;
  void revert(Document& document) override;
  bool absorb(const Command&) override { return false; }
  size_t bytes() const override;

 private:
  std::string label_;
  std::vector<Node> nodes_;
};

// Takes nodes and all that hangs below them away; undoing puts each back in its place.
class DeleteNodes final : public Command {
 public:
  DeleteNodes(const Document& document, const std::vector<NodeId>& ids,
              std::string verb = "Delete");
  std::string label() const override;
  void apply(Document& document) override;
  void revert(Document& document) override;
  bool absorb(const Command&) override { return false; }
  bool changesNothing() const override { return removed_.empty(); }
  size_t bytes() const override;

 private:
  std::string verb_;
  std::vector<std::pair<size_t, Node>> removed_;  // index before, growing
};

// Copies of nodes with all that hangs below them, under the same parents, with new ids taken from
// `nextId`. The first of the result are the copies of `ids` themselves, in that order.
struct Copies {
  std::vector<Node> nodes;    // parents before children
  std::vector<NodeId> roots;  // the copies of `ids`
};
Copies copyNodes(Scene& scene, const std::vector<NodeId>& ids);

// Throws InputError where a level with so many more objects would have more than 20,000.
void requireRoomFor(const Scene& scene, size_t more);

// `ids` without those that hang below another of them, in the order of Scene::nodes.
std::vector<NodeId> topmost(const Scene& scene, const std::vector<NodeId>& ids);

}  // namespace lamplighter
