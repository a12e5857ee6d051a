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
  s.history().begin("Place");
  const size_t before = s.document().scene.nodes.size();
  const bool isAdded = s.runAction(action) && s.document().scene.nodes.size() > before;
  if (!isAdded) {
    s.history().cancel();
    s.startPlacing("");
    return;
  }
  Node node = *s.document().scene.find(s.document().active());
  if (const auto local = placedOn(s.document().scene, node.id, *place)) {
    node.local = *local;
    const std::string label = "Place " + node.name;
    s.history().run(std::make_unique<EditNodes>(label, s.document(), std::vector{node}));
  }
  s.history().commit();
  s.setStatus("Placed " + node.name);
  if (!goesOn) s.startPlacing("");
}

}  // namespace lamplighter
