#include "editor/lights/light_links.h"

#include <algorithm>

#include "editor/edits/edits.h"
#include "editor/lights/light_commands.h"
#include "editor/lights/light_list.h"
#include "renderer/base/error.h"
#include "renderer/scene/light_linking.h"

namespace lamplighter {

namespace {

void change(std::vector<NodeId>& list, const std::vector<NodeId>& objects, bool out) {
  for (const NodeId id : objects) {
    std::erase(list, id);
    if (out) list.push_back(id);
  }
  std::sort(list.begin(), list.end());
}

}  // namespace

std::vector<NodeId> selectedObjects(const Document& document) {
  std::vector<NodeId> out;
  for (const NodeId id : document.selection) {
    const Node* n = document.scene.find(id);
    if (n != nullptr && !emitsLight(document.scene, *n)) out.push_back(id);
  }
  return out;
}

std::vector<NodeId> leftOutBySelection(const Document& document) {
  std::vector<NodeId> out;
  for (const LightSource& light : selectedLights(document)) {
    for (const NodeId id : stateOf(document.scene, light).leftOut)
      if (document.scene.find(id) != nullptr) out.push_back(id);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

void leaveOut(const Editing& editing, const std::vector<NodeId>& lights,
              const std::vector<NodeId>& objects, bool out) {
  const std::string what = out ? "light.exclude" : "light.include";
  if (lights.empty()) throw InputError(what, "no light is selected", "select one or more");
  if (objects.empty())
    throw InputError(what, "no object is given", "select some besides the lights, or name them");
  Scene after = editing.document.scene;
  std::vector<Node> nodes;
  bool isOfSky = false;
  for (const NodeId id : lights) {
    if (id == kNoNode) {
      change(after.skyLight.leftOut, objects, out);
      isOfSky = true;
      continue;
    }
    Node* n = after.find(id);
    if (n == nullptr) throw InputError(what, "the light is not there any more", "select another");
    change(n->light.leftOut, objects, out);
    nodes.push_back(*n);
  }
  if (countLinks(after) > kMostLinks) {
    throw InputError(what,
                     "more than " + std::to_string(kMostLinks) +
                         " lists of objects that differ are too many for one scene",
                     "let lights leave out the same objects");
  }
  const std::string label =
      std::string(out ? "Leave out " : "Light again ") +
      (objects.size() == 1
           ? after.find(objects[0]) != nullptr ? after.find(objects[0])->name : "an object"
           : std::to_string(objects.size()) + " objects");
  const bool isOwnStep = !editing.history.inTransaction();
  if (isOwnStep) editing.history.begin(label);
  if (!nodes.empty())
    editing.history.run(std::make_unique<EditNodes>(label, editing.document, std::move(nodes)));
  if (isOfSky) {
    editing.history.run(std::make_unique<EditLightStates>(editing.document, after.skyLight,
                                                          editing.document.scene.lightGroups));
  }
  if (isOwnStep) editing.history.commit();
}

}  // namespace lamplighter
