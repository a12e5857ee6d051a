#include <algorithm>
#include <map>

#include "editor/actions/arguments.h"
#include "editor/actions/register_actions.h"
#include "editor/commands/edits.h"
#include "editor/session.h"

namespace lamplighter {

namespace {

bool hasSelection(const Session& s) { return !s.document().selection.empty(); }

void copy(Session& s) {
  const Scene& scene = s.document().scene;
  std::vector<Node> nodes;
  for (const Node& n : scene.nodes) {
    for (const Node* p = &n; p != nullptr; p = scene.find(p->parent)) {
      if (!s.document().isSelected(p->id)) continue;
      nodes.push_back(n);
      break;
    }
  }
  s.setClipboard(std::move(nodes));
}

// The copied nodes again, with new ids, where they were: below their parents, or at the same place
// in the world where a parent is gone.
void paste(Session& s) {
  Scene& scene = s.document().scene;
  std::vector<Node> nodes = s.clipboard();
  std::map<NodeId, NodeId> newId;
  std::vector<NodeId> roots;
  for (Node& n : nodes) {
    newId[n.id] = scene.nextId;
    n.id = scene.nextId++;
    if (const auto parent = newId.find(n.parent); parent != newId.end()) {
      n.parent = parent->second;
    } else {
      if (scene.find(n.parent) == nullptr) n.parent = kNoNode;
      roots.push_back(n.id);
    }
  }
  const std::string label = nodes.size() == 1 ? "Paste " + nodes[0].name : "Paste objects";
  s.history().run(std::make_unique<AddNodes>(label, std::move(nodes)));
  s.select(std::move(roots));
}

void remove(Session& s, const std::string& verb) {
  auto command = std::make_unique<DeleteNodes>(s.document(), s.document().selection, verb);
  s.history().run(std::move(command));
  s.select({});
}

void duplicate(Session& s) {
  Copies copies = copyNodes(s.document().scene, s.document().selection);
  for (Node& n : copies.nodes) {
    if (std::find(copies.roots.begin(), copies.roots.end(), n.id) != copies.roots.end())
      n.name += " copy";
  }
  const std::string label =
      copies.roots.size() == 1 ? "Duplicate " + copies.nodes.front().name : "Duplicate objects";
  s.history().run(std::make_unique<AddNodes>(label, std::move(copies.nodes)));
  s.select(std::move(copies.roots));
}

}  // namespace

void addEditActions(ActionRegistry& r) {
  r.add({"edit.undo", "Undo", "", "Takes the last change back.", "Ctrl+Z",
         [](Session& s, const Arguments&) { s.undo(); },
         [](const Session& s) { return s.dragging() || s.history().canUndo(); }, true});
  r.add({"edit.redo", "Redo", "", "Makes the change again that was taken back.",
         "Ctrl+Y, Ctrl+Shift+Z", [](Session& s, const Arguments&) { s.redo(); },
         [](const Session& s) { return s.history().canRedo(); }});
  r.add({"edit.delete", "Delete", "", "Deletes what is selected.", "Delete",
         [](Session& s, const Arguments&) { remove(s, "Delete"); }, hasSelection});
  r.add({"edit.copy", "Copy", "", "Puts what is selected by, to be pasted.", "Ctrl+C",
         [](Session& s, const Arguments&) { copy(s); }, hasSelection});
  r.add({"edit.cut", "Cut", "", "Deletes what is selected and puts it by.", "Ctrl+X",
         [](Session& s, const Arguments&) {
           copy(s);
           remove(s, "Cut");
         },
         hasSelection});
  r.add({"edit.paste", "Paste", "", "Adds what was copied, where it was.", "Ctrl+V",
         [](Session& s, const Arguments&) { paste(s); },
         [](const Session& s) { return !s.clipboard().empty(); }});
  r.add({"edit.duplicate", "Duplicate", "", "Copies what is selected to the same place.", "Ctrl+D",
         [](Session& s, const Arguments&) { duplicate(s); }, hasSelection});
  r.add({"edit.rename",
         "Rename",
         "NAME",
         "Gives the active object another name.",
         "F2",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1, "edit.rename NAME");
           s.setName(activeNode(s.document()).id, a[0]);
         },
         {}});
  r.add({"select.name",
         "Select by name",
         "NAME [NAME]…",
         "Selects the objects of these names.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 1, 1000000, "select.name NAME [NAME]…");
           std::vector<NodeId> ids;
           for (const std::string& name : a) ids.push_back(nodeNamed(s.document(), name).id);
           s.select(std::move(ids));
         },
         {}});
  r.add({"select.all",
         "Select all",
         "",
         "Selects every object and light.",
         "Ctrl+A",
         [](Session& s, const Arguments&) {
           std::vector<NodeId> ids;
           for (const Node& n : s.document().scene.nodes) {
             if (n.mesh != kNone || n.area || n.punctual) ids.push_back(n.id);
           }
           s.select(std::move(ids));
         },
         {}});
  r.add({"select.none", "Deselect", "",
         "Takes back a drag under way, or puts down a tool that clicks ask; else selects nothing.",
         "Escape",
         [](Session& s, const Arguments&) {
           if (s.dragging())
             s.cancelDrag();
           else if (s.points().tool() != PointTool::none)
             s.points().setTool(PointTool::none);
           else
             s.select({});
         },
         [](const Session& s) { return hasSelection(s) || s.points().tool() != PointTool::none; },
         true});
}

}  // namespace lamplighter
