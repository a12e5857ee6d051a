// Actions of the object tree, and edits of several objects.
#include <cmath>

#include "editor/actions/arguments.h"
#include "editor/edits/object_edits.h"
#include "editor/edits/tree.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

std::vector<NodeId> lockedNodes(const Session& s) {
  std::vector<NodeId> ids;
  for (const Node& n : s.document().scene.nodes)
    if (n.locked) ids.push_back(n.id);
  return ids;
}

float shareOf(const std::string& text) {
  const float value = numberOf(text);
  if (!(value >= 0.0f && value <= 1.0f))
    throw InputError(text, "is not from 0 to 1", "give a number in that range");
  return value;
}

}  // namespace

void addTreeActions(ActionRegistry& r) {
  r.add({"object.reparent", "Hang below", "PARENT|none",
         "Makes the selection a child of the named object, or a root of the tree. Its world "
         "transform stays the same.",
         "",
         [](Session& s, const Arguments& a) {
           activeNode(s.document());
           reparent(s.editing(), s.document().selection,
                    a[0] == "none" ? kNoNode : nodeNamed(s.document(), a[0]).id);
         },
         hasSelection});
  r.add(
      {"object.lock", "Lock or unlock", "",
       "Locks the selection, so that it cannot be picked or moved in the viewport, or unlocks it.",
       "Shift+H",
       [](Session& s, const Arguments&) {
         setLocked(s.editing(), s.document().selection, !activeNode(s.document()).locked);
       },
       hasSelection});
  r.add({"object.unlock_all", "Unlock all", "", "Unlocks every object.", "",
         [](Session& s, const Arguments&) { setLocked(s.editing(), lockedNodes(s), false); },
         [](const Session& s) { return !lockedNodes(s).empty(); }});
  r.add({"objects.set", "Set of objects", "PROPERTY VALUE",
         "Gives all selected objects the same position, rotation (degrees) or scale along an axis, "
         "as in position.y 2, relative to their parents.",
         "",
         [](Session& s, const Arguments& a) {
           const ObjectProperty& property = objectProperty(a[0]);
           const float value = numberOf(a[1]);
           if (!(std::abs(value) <= 1e6f))
             throw InputError(a[1], "is larger than 1000000", "give a smaller number");
           setNumber(s.editing(), property, value);
         },
         hasSelection});
  r.add({"objects.lit_as", "Light objects as", "automatic|simple|complex",
         "Sets how all selected meshes are lit: by light maps, or per pixel. Per pixel costs time "
         "in each frame, light maps cost memory.",
         "",
         [](Session& s, const Arguments& a) {
           const MeshKind kind = a[0] == "simple"    ? MeshKind::simple
                                 : a[0] == "complex" ? MeshKind::complex
                                                     : MeshKind::automatic;
           if (kind == MeshKind::automatic && a[0] != "automatic")
             throw InputError(a[0], "is not a way to light a mesh",
                              "give automatic, simple or complex");
           editSelected(
               s.editing(), "Light", [](const Node& n) { return n.mesh != kNone; },
               [&](Node& n) { n.meshKind = kind; });
         },
         hasSelection});
  r.add({"materials.roughness", "Roughness of objects", "VALUE",
         "Sets the roughness of all materials of the selected objects, from 0 to 1.", "",
         [](Session& s, const Arguments& a) {
           const float value = shareOf(a[0]);
           editMaterials(s.editing(), "Change roughness",
                         [&](Material& m) { m.roughness = value; });
         },
         hasSelection});
  r.add({"materials.metallic", "Metallic of objects", "VALUE",
         "Sets the metallic value of all materials of the selected objects, from 0 to 1.", "",
         [](Session& s, const Arguments& a) {
           const float value = shareOf(a[0]);
           editMaterials(s.editing(), "Change metallic", [&](Material& m) { m.metallic = value; });
         },
         hasSelection});
  r.add({"materials.colour", "Colour of objects", "R G B",
         "Sets the linear base colour of all materials of the selected objects.", "",
         [](Session& s, const Arguments& a) {
           const vec3 colour = glm::clamp(vectorOf(a, 0), 0.0f, 1.0f);
           editMaterials(s.editing(), "Change colour",
                         [&](Material& m) { m.baseColor = vec4(colour, m.baseColor.a); });
         },
         hasSelection});
}

}  // namespace lamplighter
