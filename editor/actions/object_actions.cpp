#include <algorithm>

#include "editor/actions/arguments.h"
#include "editor/edits/edits.h"
#include "editor/edits/placement.h"
#include "editor/edits/tree.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

// Moves the active object to the surface under the pointer: objects stand on it, lights face away
// from it. The other selected objects keep their positions relative to it.
void drop(Session& s) {
  const Scene& scene = s.document().scene;
  const Node& active = activeNode(s.document());
  if (isLocked(scene, active.id)) throw InputError(active.name, "is locked", "unlock it first");
  auto place = s.surfaceUnderPointer(s.document().selection);
  if (!place) place = s.surfaceAhead(s.document().selection);
  if (!place)
    throw InputError("object.drop", "there is no surface under the pointer", "point at a surface");
  // If an ancestor of the active object is selected, it moves instead.
  const std::vector<NodeId> roots = topmost(scene, s.document().selection);
  NodeId leader = active.id;
  for (const Node* n = &active; n != nullptr; n = scene.find(n->parent)) {
    if (std::find(roots.begin(), roots.end(), n->id) != roots.end()) leader = n->id;
  }
  const auto local = placedOn(scene, leader, {place->position, place->normal}, s.unit());
  if (!local) {
    throw InputError(active.name, "has a parent with a scale of 0",
                     "give the parent a scale other than 0");
  }
  std::vector<Node> nodes{*scene.find(leader)};
  const mat4 above = worldMatrix(scene, nodes[0].parent);
  const vec3 way =
      vec3(above * vec4(local->translation, 1.0f)) - vec3(worldMatrix(scene, leader)[3]);
  nodes[0].local = *local;
  for (const NodeId id : roots) {
    if (id == leader || isLocked(scene, id)) continue;
    Node n = *scene.find(id);
    const mat4 parent = worldMatrix(scene, n.parent);
    if (!hasVolume(parent)) continue;
    n.local.translation += glm::inverse(mat3(parent)) * way;
    nodes.push_back(std::move(n));
  }
  const std::string what = nodes.size() == 1 ? nodes[0].name : "objects";
  setNodes(s.editing(), "Drop " + what, std::move(nodes));
}

}  // namespace

void addObjectActions(ActionRegistry& r) {
  r.add({"object.drop", "Drop under the cursor", "",
         "Puts the selection on the surface under the pointer.", "Ctrl+T",
         [](Session& s, const Arguments&) { drop(s); }, hasSelection});
  r.add({"object.move", "Move to", "X Y Z",
         "Sets the position of the active object, in metres, in its parent's space.", "",
         [](Session& s, const Arguments& a) {
           Node n = activeNode(s.document());
           n.local.translation = vectorOf(a, 0);
           s.setNodeTransform(n.id, n.local);
         }});
  r.add({"object.rotate", "Rotate to", "X Y Z",
         "Sets the rotation of the active object about X, Y and Z, in degrees.", "",
         [](Session& s, const Arguments& a) {
           Node n = activeNode(s.document());
           n.local.rotation = quat(glm::radians(vectorOf(a, 0)));
           s.setNodeTransform(n.id, n.local);
         }});
  r.add({"object.scale", "Scale to", "X Y Z", "Scales the active object along its own axes.", "",
         [](Session& s, const Arguments& a) {
           Node n = activeNode(s.document());
           n.local.scale = vectorOf(a, 0);
           s.setNodeTransform(n.id, n.local);
         }});
  r.add({"object.hide", "Hide or show", "", "Hides the selection, or shows it again.", "H",
         [](Session& s, const Arguments&) {
           const bool visible = !activeNode(s.document()).visible;
           Transaction edit = s.editing().begin(visible ? "Show" : "Hide");
           for (const NodeId id : s.document().selection) edit.node(id).visible = visible;
           edit.commit();
         },
         hasSelection});
}

}  // namespace lamplighter
