#include <algorithm>

#include "editor/actions/arguments.h"
#include "editor/actions/register_actions.h"
#include "editor/commands/edits.h"
#include "editor/session.h"
#include "renderer/error.h"

namespace lamplighter {

namespace {

bool hasSelection(const Session& s) { return !s.document().selection.empty(); }

// How far the node's own meshes and those below it reach along −n from its origin, in metres: where
// it touches when it is set down with its underside on a plane of normal n. 0 for lights.
float depthBelow(const Scene& scene, NodeId id, const vec3& n) {
  const std::vector<mat4> world = worldMatrices(scene);
  const vec3 origin = vec3(worldMatrix(scene, id)[3]);
  float lowest = 0.0f;
  bool found = false;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Node& node = scene.nodes[i];
    if (node.mesh == kNone) continue;
    bool mine = node.id == id;
    for (const Node* p = scene.find(node.parent); p != nullptr && !mine; p = scene.find(p->parent))
      mine = p->id == id;
    if (!mine) continue;
    for (const Primitive& primitive : scene.meshes[node.mesh]->primitives) {
      for (const vec3& q : primitive.positions) {
        const float height = glm::dot(vec3(world[i] * vec4(q, 1.0f)) - origin, n);
        lowest = found ? std::min(lowest, height) : height;
        found = true;
      }
    }
  }
  return lowest;
}

// Puts the active object on the surface under the pointer: objects stand on it, lights face away.
void drop(Session& s) {
  const Node& node = activeNode(s.document());
  auto place = s.surfaceUnderPointer(s.document().selection);
  if (!place) place = s.surfaceAhead();
  if (!place)
    throw InputError("object.drop", "there is no surface under the pointer", "point at one");
  const mat4 parent =
      node.parent == kNoNode ? mat4(1.0f) : worldMatrix(s.document().scene, node.parent);
  Transform local = node.local;
  vec3 at = place->position;
  if (node.area || node.punctual) {
    constexpr float kLift = 0.01f;  // m: off the surface, so that it is not hidden in it
    at += kLift * place->normal;
    if (node.area && node.area->shape == AreaShape::sphere)
      at += 0.5f * node.area->size.x * place->normal;
    const Frame f(-place->normal);  // −Z of the light along the normal: Z along −normal
    const quat world = glm::quat_cast(mat3(f.tangent, f.bitangent, f.normal));
    local.rotation = glm::normalize(glm::inverse(decompose(parent).rotation) * world);
  } else {
    at -= depthBelow(s.document().scene, node.id, place->normal) * place->normal;
  }
  local.translation = vec3(glm::inverse(parent) * vec4(at, 1.0f));
  s.setNodeTransform(node.id, local);
}

}  // namespace

void addObjectActions(ActionRegistry& r) {
  r.add({"object.drop", "Drop under the cursor", "",
         "Puts the active object on the surface under the pointer.", "Ctrl+T",
         [](Session& s, const Arguments&) { drop(s); }, hasSelection});
  r.add({"object.move",
         "Move to",
         "X Y Z",
         "Puts the active object at a place, in metres, in its parent's space.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 3, 3, "object.move X Y Z");
           Node n = activeNode(s.document());
           n.local.translation = vectorOf(a, 0);
           s.setNodeTransform(n.id, n.local);
         },
         {}});
  r.add({"object.rotate",
         "Rotate to",
         "X Y Z",
         "Turns the active object to angles about X, Y and Z, in degrees.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 3, 3, "object.rotate X Y Z");
           Node n = activeNode(s.document());
           n.local.rotation = quat(glm::radians(vectorOf(a, 0)));
           s.setNodeTransform(n.id, n.local);
         },
         {}});
  r.add({"object.scale",
         "Scale to",
         "X Y Z",
         "Scales the active object along its own axes.",
         "",
         [](Session& s, const Arguments& a) {
           requireArguments(a, 3, 3, "object.scale X Y Z");
           Node n = activeNode(s.document());
           n.local.scale = vectorOf(a, 0);
           s.setNodeTransform(n.id, n.local);
         },
         {}});
  r.add({"object.hide", "Hide or show", "", "Hides what is selected, or shows it again.", "H",
         [](Session& s, const Arguments&) {
           const bool visible = !activeNode(s.document()).visible;
           std::vector<Node> nodes;
           for (const NodeId id : s.document().selection) {
             nodes.push_back(*s.document().scene.find(id));
             nodes.back().visible = visible;
           }
           s.history().run(std::make_unique<EditNodes>(visible ? "Show" : "Hide", s.document(),
                                                       std::move(nodes)));
         },
         hasSelection});
}

}  // namespace lamplighter
