// Actions that place objects: by a click, in rows and grids, along surfaces.
#include <cmath>
#include <unordered_set>

#include "editor/actions/arguments.h"
#include "editor/edits/edits.h"
#include "editor/edits/placement.h"
#include "editor/edits/tree.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr int kMostCopies = 10000;

int countOf(const std::string& text) {
  const float value = numberOf(text);
  if (value != std::floor(value) || value < 1.0f || value > static_cast<float>(kMostCopies))
    throw InputError(text, "is not a number of copies", "give a whole number from 1 to 10000");
  return static_cast<int>(value);
}

// Copies the selection into the cells of a grid. The selection itself is the first cell. `steps`:
// the offsets between cells along the world axes [m].
void duplicateInGrid(Session& s, const glm::ivec3& count, const mat3& steps,
                     const std::string& label) {
  const double cells = static_cast<double>(count.x) * count.y * count.z;
  if (cells - 1.0 > kMostCopies)
    throw InputError(std::to_string(static_cast<long long>(cells)) + " copies",
                     "are too many for one step", "make at most 10000");
  const Scene& scene = s.document().scene;
  const std::vector<NodeId> originals = s.document().selection;
  std::vector<Node> nodes;
  std::vector<NodeId> roots = originals;
  for (int z = 0; z < count.z; ++z) {
    for (int y = 0; y < count.y; ++y) {
      for (int x = 0; x < count.x; ++x) {
        if (x == 0 && y == 0 && z == 0) continue;
        const vec3 way = steps * vec3(x, y, z);
        Copies copies = copyNodes(s.editing(), originals);
        if (nodes.empty())
          requireRoomFor(scene, copies.nodes.size() * static_cast<size_t>(cells - 1.0));
        const std::unordered_set<NodeId> isRoot(copies.roots.begin(), copies.roots.end());
        for (Node& n : copies.nodes) {
          if (!isRoot.contains(n.id)) continue;
          const mat4 parent = worldMatrix(scene, n.parent);
          if (!hasVolume(parent)) continue;
          n.local.translation += glm::inverse(mat3(parent)) * way;
        }
        nodes.insert(nodes.end(), copies.nodes.begin(), copies.nodes.end());
        roots.insert(roots.end(), copies.roots.begin(), copies.roots.end());
      }
    }
  }
  if (nodes.empty()) return;
  addNodes(s.editing(), label, std::move(nodes));
  s.select(std::move(roots));
}

// Rotates the active object so that its up axis, or the direction of a light, matches the normal of
// the surface under the pointer. Its position does not change.
void align(Session& s) {
  const Node& active = activeNode(s.document());
  if (isLocked(s.document().scene, active.id))
    throw InputError(active.name, "is locked", "unlock it first");
  auto place = s.surfaceUnderPointer({active.id});
  if (!place) place = s.surfaceAhead({active.id});
  if (!place)
    throw InputError("object.align", "there is no surface under the pointer", "point at a surface");
  Node node = active;
  const Scene& scene = s.document().scene;
  const mat4 parent = worldMatrix(scene, node.parent);
  if (!hasVolume(parent))
    throw InputError(node.name, "has a parent with a scale of 0",
                     "give the parent a scale other than 0");
  const quat now = decompose(worldMatrix(scene, node.id)).rotation;
  const bool isLight = node.area || node.punctual;
  node.local.rotation = glm::normalize(
      glm::inverse(decompose(parent).rotation) *
      leastTurn(now * (isLight ? vec3(0, 0, -1) : vec3(0, 1, 0)), place->normal) * now);
  s.setNodeTransform(node.id, node.local);
}

}  // namespace

void addPlaceActions(ActionRegistry& r) {
  r.add({"place.start", "Click to place", "ACTION [ARGUMENT]…",
         "The next click in the viewport runs an action that adds an object, such as light.add "
         "disk, and puts the object on the clicked surface, facing away from it. With Shift, the "
         "tool stays active.",
         "", [](Session& s, const Arguments& a) {
           if (s.actions().find(a[0]) == nullptr)
             throw InputError(a[0], "there is no such action", "give one such as light.add disk");
           s.startPlacing(callText(a));
           s.setStatus("Click a surface to place it; Esc cancels", NoticeKind::hint);
         }});
  const std::string kinds = r.find("light.add")->usage;
  r.add({"light.place", "Click to place a light", kinds,
         "The next click in the viewport adds a light on the clicked surface, facing away from it. "
         "With Shift, the tool stays active.",
         "", [](Session& s, const Arguments& a) { s.runAction("place.start light.add " + a[0]); }});
  r.add({"place.stop", "Place nothing", "", "Ends placing: clicks select again.", "",
         [](Session& s, const Arguments&) { s.startPlacing(""); },
         [](const Session& s) { return s.placing(); }});
  r.add({"object.align", "Align to the surface", "",
         "Aligns the active object to the normal of the surface under the pointer. A light faces "
         "away from the surface.",
         "Ctrl+Shift+T", [](Session& s, const Arguments&) { align(s); }, hasSelection});
  r.add({"edit.duplicate_line", "Duplicate along a line", "COPIES X Y Z",
         "Adds copies of the selection along a line. X, Y and Z are the offset from one copy to "
         "the next, in metres.",
         "",
         [](Session& s, const Arguments& a) {
           const vec3 step = vectorOf(a, 1);
           duplicateInGrid(s, {countOf(a[0]) + 1, 1, 1}, mat3(step, vec3(0.0f), vec3(0.0f)),
                           "Duplicate along a line");
         },
         hasSelection});
  r.add({"edit.duplicate_grid", "Duplicate in a grid", "COLUMNS ROWS LAYERS X Y Z",
         "Adds copies of the selection in a grid: columns along X, rows along Z, layers along Y. "
         "X, Y and Z are the spacing in metres.",
         "",
         [](Session& s, const Arguments& a) {
           const vec3 step = vectorOf(a, 3);
           duplicateInGrid(s, {countOf(a[0]), countOf(a[2]), countOf(a[1])},
                           mat3(vec3(step.x, 0, 0), vec3(0, step.y, 0), vec3(0, 0, step.z)),
                           "Duplicate in a grid");
         },
         hasSelection});
  const auto addSnap = [&](const char* name, const char* label, const char* help, SnapTo target) {
    r.add({name, label, "", help, "",
           [target](Session& s, const Arguments&) { s.setSnapTo(target); }, nullptr, true,
           [target](const Session& s) { return s.snapTo() == target; }});
  };
  addSnap("tool.snap_grid", "Snap to steps", "Snaps positions to a grid of 25 cm.", SnapTo::grid);
  addSnap("tool.snap_surface", "Snap to surfaces",
          "Snaps positions to the surface under the pointer.", SnapTo::surface);
  addSnap("tool.snap_vertex", "Snap to vertices",
          "Snaps positions to the vertex under the pointer.", SnapTo::vertex);
}

}  // namespace lamplighter
