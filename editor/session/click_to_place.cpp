#include "editor/session/click_to_place.h"

#include "editor/edits/edits.h"
#include "editor/session/session.h"

namespace lamplighter {

void placeUnderPointer(Session& s, bool goesOn) {
  const auto place = s.surfaceUnderPointer({});
  if (!place) {
    s.setStatus("There is no surface to place it on");
    return;
  }
  const std::string action = s.placed();
  s.editing().commit();
  Transaction edit = s.editing().begin("Place");
  const size_t before = s.document().scene.nodes.size();
  const bool isAdded = s.runAction(action) && s.document().scene.nodes.size() > before;
  const Node* added = s.document().scene.find(s.document().active());
  if (!isAdded || added == nullptr) return s.startPlacing("");
  Node node = *added;
  if (const auto local = placedOn(s.document().scene, node.id, *place, s.unit())) {
    node.local = *local;
    setNodes(s.editing(), "Place " + node.name, {node});
  }
  edit.commit();
  s.setStatus("Placed " + node.name);
  if (!goesOn) s.startPlacing("");
}

}  // namespace lamplighter
