#include <algorithm>
#include <unordered_set>

#include "editor/actions/arguments.h"
#include "editor/edits/clipboard_fragment.h"
#include "editor/edits/edits.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"

namespace lamplighter {

namespace {

void copy(Session& s) { s.setClipboard(clip(s.document().scene, s.document().selection)); }

// Adds the copied nodes with new ids at their original positions, in the same or another level.
void paste(Session& s) {
  PastedNodes pasting = pasteInto(s.editing(), s.clipboard(), s.clipboardIsOfThisLevel());
  requireRoomFor(s.document().scene, pasting.nodes.size());
  const std::string label =
      pasting.nodes.size() == 1 ? "Paste " + pasting.nodes[0].name : "Paste objects";
  const std::vector<NodeId> roots = pasting.roots;
  Transaction edit = s.editing().begin(label);
  add(edit, std::move(pasting));
  edit.commit();
  s.select(roots);
}

void remove(Session& s, const std::string& verb) {
  const Scene& scene = s.document().scene;
  const std::vector<bool> isRemoved = withDescendants(scene, s.document().selection);
  const auto first = std::find(isRemoved.begin(), isRemoved.end(), true);
  const bool isOne = std::count(first, isRemoved.end(), true) == 1;
  Transaction edit = s.editing().begin(
      verb + " " +
      (isOne ? scene.nodes[static_cast<size_t>(first - isRemoved.begin())].name : "objects"));
  edit.removeNodes(s.document().selection);
  edit.commit();
  s.select({});
}

void duplicate(Session& s) {
  Copies copies = copyNodes(s.editing(), s.document().selection);
  requireRoomFor(s.document().scene, copies.nodes.size());
  const std::unordered_set<NodeId> isRoot(copies.roots.begin(), copies.roots.end());
  for (Node& n : copies.nodes)
    if (isRoot.contains(n.id)) n.name += " copy";
  const std::string label =
      copies.roots.size() == 1 ? "Duplicate " + copies.nodes.front().name : "Duplicate objects";
  addNodes(s.editing(), label, std::move(copies.nodes));
  s.select(std::move(copies.roots));
}

}  // namespace

void addEditActions(ActionRegistry& r) {
  r.add({"edit.undo", "Undo", "", "Undoes the last change.", "Ctrl+Z",
         [](Session& s, const Arguments&) { s.undo(); },
         [](const Session& s) { return s.dragging() || s.editing().canUndo(); }, true});
  r.add({"edit.redo", "Redo", "", "Redoes the last undone change.", "Ctrl+Y, Ctrl+Shift+Z",
         [](Session& s, const Arguments&) { s.redo(); },
         [](const Session& s) { return s.editing().canRedo(); }});
  r.add({"edit.delete", "Delete", "", "Deletes the selection.", "Delete",
         [](Session& s, const Arguments&) { remove(s, "Delete"); }, hasSelection});
  r.add({"edit.copy", "Copy", "", "Copies the selection to the clipboard.", "Ctrl+C",
         [](Session& s, const Arguments&) { copy(s); }, hasSelection});
  r.add({"edit.cut", "Cut", "", "Copies the selection to the clipboard and deletes it.", "Ctrl+X",
         [](Session& s, const Arguments&) {
           copy(s);
           remove(s, "Cut");
         },
         hasSelection});
  r.add({"edit.paste", "Paste", "",
         "Adds the objects of the clipboard at their original position, in this level or another.",
         "Ctrl+V", [](Session& s, const Arguments&) { paste(s); },
         [](const Session& s) { return !s.clipboard().empty(); }});
  r.add({"edit.duplicate", "Duplicate", "", "Adds a copy of the selection at the same position.",
         "Ctrl+D", [](Session& s, const Arguments&) { duplicate(s); }, hasSelection});
  r.add({"edit.rename", "Rename", "NAME", "Renames the active object.", "F2",
         [](Session& s, const Arguments& a) { s.setName(activeNode(s.document()).id, a[0]); }})
      .asks = {.kind = ActionAsk::Kind::name, .title = "Rename", .suggested = [](const Session& s) {
                 return activeNode(s.document()).name;
               }};
  r.add({"select.name", "Select by name", "NAME [NAME]…", "Selects the objects of these names.", "",
         [](Session& s, const Arguments& a) {
           std::vector<NodeId> ids;
           for (const std::string& name : a) ids.push_back(nodeNamed(s.document(), name).id);
           s.select(std::move(ids));
         }});
  r.add({"select.all", "Select all", "", "Selects every object and light.", "Ctrl+A",
         [](Session& s, const Arguments&) {
           std::vector<NodeId> ids;
           for (const Node& n : s.document().scene.nodes) {
             if (n.mesh != kNone || n.area || n.punctual) ids.push_back(n.id);
           }
           s.select(std::move(ids));
         }});
  r.add({"select.none", "Deselect", "",
         "Cancels a drag, ends placing or ends a tool that uses clicks; otherwise clears the "
         "selection.",
         "Escape",
         [](Session& s, const Arguments&) {
           if (s.dragging())
             s.cancelDrag();
           else if (s.placing())
             s.startPlacing("");
           else if (s.points().tool() != PointTool::none)
             s.points().setTool(PointTool::none);
           else
             s.select({});
         },
         [](const Session& s) {
           return hasSelection(s) || s.placing() || s.points().tool() != PointTool::none;
         },
         true});
}

}  // namespace lamplighter
