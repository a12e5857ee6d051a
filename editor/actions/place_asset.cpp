#include "editor/actions/place_asset.h"

#include "editor/edits/clipboard_fragment.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"

namespace lamplighter {

void placeAsset(Session& s, const std::filesystem::path& file) {
  const auto fragment = s.home().assets.load(file);
  PastedNodes pasting = pasteInto(s.editing(), *fragment, false);
  NodeId root = pasting.roots.front();
  if (pasting.roots.size() > 1) {
    // A group, so that the asset moves as one object even if it has several nodes.
    Node group;
    group.id = root = s.editing().newNodeId();
    for (Node& n : pasting.nodes)
      if (n.parent == kNoNode) n.parent = group.id;
    pasting.nodes.insert(pasting.nodes.begin(), std::move(group));
  }
  const std::string name = file.stem().string() + " " + std::to_string(root);
  for (Node& n : pasting.nodes)
    if (n.id == root) n.name = name;

  Transaction edit = s.editing().begin("Place " + name);
  add(edit, std::move(pasting));
  if (const auto place = s.surfaceAhead()) {
    if (const auto local = placedOn(s.document().scene, root, *place, s.unit()))
      edit.node(root).local = *local;
  }
  edit.commit();
  s.select({root});
}

}  // namespace lamplighter
