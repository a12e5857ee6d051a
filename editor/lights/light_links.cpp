#include "editor/lights/light_links.h"

#include <algorithm>

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

void leaveOut(Editing& editing, const std::vector<NodeId>& lights,
              const std::vector<NodeId>& objects, bool out) {
  const std::string what = out ? "light.exclude" : "light.include";
  if (lights.empty()) throw InputError(what, "no light is selected", "select one or more");
  if (objects.empty())
    throw InputError(what, "no object is given",
                     "select objects in addition to the lights, or name them");
  const Scene& scene = editing.document().scene;
  const Node* object = scene.find(objects[0]);
  const std::string whose = objects.size() > 1  ? std::to_string(objects.size()) + " objects"
                            : object != nullptr ? object->name
                                                : "an object";
  Transaction edit = editing.begin((out ? "Leave out " : "Light again ") + whose);
  for (const NodeId id : lights) {
    if (id != kNoNode && scene.find(id) == nullptr)
      throw InputError(what, "the light no longer exists", "select another");
    LightState& light = id == kNoNode ? edit.skyLight() : edit.node(id).light;
    change(light.leftOut, objects, out);
  }
  if (countLinks(scene) > kMostLinks) {
    throw InputError(what,
                     "a scene can have at most " + std::to_string(kMostLinks) +
                         " different lists of excluded objects",
                     "let several lights exclude the same objects");
  }
  edit.commit();
}

}  // namespace lamplighter
