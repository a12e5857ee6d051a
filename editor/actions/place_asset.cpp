#include "editor/actions/place_asset.h"

#include "editor/edits/edits.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"

namespace lamplighter {

void placeAsset(Session& s, const std::filesystem::path& file) {
  const auto fragment = s.home().assets.load(file);
  Scene& scene = s.document().scene;
  PastedNodes pasting = pasteInto(scene, *fragment, false);
  NodeId root = pasting.roots.front();
  if (pasting.roots.size() > 1) {
    // A group, so that the asset moves as one object even if it has several nodes.
    Node group;
    group.id = root = scene.nextId++;
    for (Node& n : pasting.nodes)
      if (n.parent == kNoNode) n.parent = group.id;
    pasting.nodes.insert(pasting.nodes.begin(), std::move(group));
  }
  const std::string name = file.stem().string() + " " + std::to_string(root);
  for (Node& n : pasting.nodes)
    if (n.id == root) n.name = name;

  // When the asset is placed by a click, a transaction is already open.
  const bool isOwnStep = !s.history().inTransaction();
  if (isOwnStep) s.history().begin("Place " + name);
  if (!pasting.assets->changesNothing()) s.history().run(std::move(pasting.assets));
  s.history().run(std::make_unique<AddNodes>("Place " + name, std::move(pasting.nodes)));
  if (const auto place = s.surfaceAhead()) {
    if (const auto local = placedOn(scene, root, *place)) {
      Node node = *scene.find(root);
      node.local = *local;
      s.history().run(
          std::make_unique<EditNodes>("Place " + name, s.document(), std::vector{node}));
    }
  }
  if (isOwnStep) s.history().commit();
  s.select({root});
}

}  // namespace lamplighter
