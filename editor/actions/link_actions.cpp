// Actions of light linking.
#include "editor/actions/arguments.h"
#include "editor/lights/light_links.h"
#include "editor/lights/light_list.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"

namespace lamplighter {

namespace {

constexpr const char* kObjects = "[OBJECT]\u2026";

std::vector<NodeId> lightsOfSelection(const Session& s) {
  std::vector<NodeId> ids;
  for (const LightSource& light : selectedLights(s.document())) ids.push_back(light.node);
  return ids;
}

// The named objects; without names the selected objects; without a selection `otherwise`.
std::vector<NodeId> objectsOf(const Session& s, const Arguments& a,
                              const std::vector<NodeId>& otherwise) {
  std::vector<NodeId> ids;
  for (const std::string& name : a) ids.push_back(nodeNamed(s.document(), name).id);
  if (ids.empty()) ids = selectedObjects(s.document());
  return ids.empty() ? otherwise : ids;
}

}  // namespace

void addLinkActions(ActionRegistry& r) {
  const auto hasLights = [](const Session& s) { return !selectedLights(s.document()).empty(); };
  const auto hasLeftOut = [](const Session& s) {
    return !leftOutBySelection(s.document()).empty();
  };
  r.add({"light.exclude", "Leave objects out", kObjects,
         "Excludes the selected or named objects and their children from the selected lights.", "",
         [](Session& s, const Arguments& a) {
           leaveOut(s.editing(), lightsOfSelection(s), objectsOf(s, a, {}), true);
         },
         hasLights});
  r.add({"light.include", "Light objects again", kObjects,
         "Ends the exclusion of the selected or named objects from the selected lights. With "
         "neither, of all objects.",
         "",
         [](Session& s, const Arguments& a) {
           leaveOut(s.editing(), lightsOfSelection(s),
                    objectsOf(s, a, leftOutBySelection(s.document())), false);
         },
         hasLeftOut});
  r.add({"light.select_excluded", "Select what is left out", "",
         "Selects the objects that are excluded from the selected lights.", "",
         [](Session& s, const Arguments&) { s.select(leftOutBySelection(s.document())); },
         hasLeftOut});
  r.add({"sky.exclude", "Leave objects out of the sky", kObjects,
         "Excludes the selected or named objects and their children from the light of the sky.", "",
         [](Session& s, const Arguments& a) {
           leaveOut(s.editing(), {kNoNode}, objectsOf(s, a, {}), true);
         }});
  r.add({"sky.include", "Light objects by the sky again", kObjects,
         "Ends the exclusion of the selected or named objects from the light of the sky. With "
         "neither, of all objects.",
         "",
         [](Session& s, const Arguments& a) {
           leaveOut(s.editing(), {kNoNode}, objectsOf(s, a, s.document().scene.skyLight.leftOut),
                    false);
         },
         [](const Session& s) { return !s.document().scene.skyLight.leftOut.empty(); }});
}

}  // namespace lamplighter
