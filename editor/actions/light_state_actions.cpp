// Actions that switch lights: on, solo, groups; also the light table and the work light.
#include "editor/actions/arguments.h"
#include "editor/lights/light_edits.h"
#include "editor/session/register_actions.h"
#include "editor/session/session.h"
#include "editor/session/user_state.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr const char* kTrueFalse = "true|false";

bool flagOf(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  throw InputError(text, "is neither true nor false", "give true or false");
}

// A switch of the selected lights or of the sky. With one argument: true or false.
void addSwitch(ActionRegistry& r, const std::string& name, const char* label, const char* help,
               std::function<void(Session&, bool)> run) {
  r.add({name, label, kTrueFalse, help, "",
         [run](Session& s, const Arguments& a) { run(s, flagOf(a[0])); }});
}

void addGroupSwitch(ActionRegistry& r, const std::string& name, const char* label, const char* help,
                    bool LightGroup::*flag) {
  r.add({name, label, "NAME true|false", help, "", [label, flag](Session& s, const Arguments& a) {
           const bool value = flagOf(a[1]);
           editLightGroup(s.editing(), label, a[0], [&](LightGroup& g) { g.*flag = value; });
         }});
}

// Chooses the intensity for the current view.
void toggleWorkLight(Session& s) {
  if (s.lighting().workLight > 0.0f) {
    s.lighting().workLight = 0.0f;
    return;
  }
  float distance = 0.5f * std::max(s.bounds().radius(), 0.1f * s.unit());
  if (const auto ahead = s.surfaceAhead()) distance = glm::length(ahead->position - s.view().eye);
  s.lighting().workLight = workLightIntensity(
      std::clamp(distance, 0.2f * s.unit(), 100.0f * s.unit()), s.document().render.exposureEv);
}

}  // namespace

void addLightStateActions(ActionRegistry& r) {
  addSwitch(r, "lights.on", "Switch lights on or off", "Switches the selected lights on or off.",
            [](Session& s, bool on) {
              editLightStates(s.editing(), on ? "Switch on" : "Switch off",
                              [on](LightState& state) { state.on = on; });
            });
  addSwitch(r, "lights.solo", "Solo lights",
            "While any light is solo, only lights that are solo emit.", [](Session& s, bool solo) {
              editLightStates(s.editing(), solo ? "Solo" : "End solo of",
                              [solo](LightState& state) { state.solo = solo; });
            });
  addSwitch(r, "sky.on", "Switch sky on or off", "Switches the sky on or off.",
            [](Session& s, bool on) {
              editSkyState(s.editing(), on ? "Switch on the sky" : "Switch off the sky",
                           [on](LightState& state) { state.on = on; });
            });
  addSwitch(r, "sky.solo", "Solo sky",
            "While the sky is solo, only the sky and lights that are solo emit.",
            [](Session& s, bool solo) {
              editSkyState(s.editing(), solo ? "Solo the sky" : "End solo of the sky",
                           [solo](LightState& state) { state.solo = solo; });
            });
  r.add({"lights.all_on", "Switch all lights on", "",
         "Switches all lights on and clears every solo and mute.", "",
         [](Session& s, const Arguments&) { shineAll(s.editing()); },
         [](const Session& s) { return anyLightDark(s.document().scene); }});
  r.add({"lights.group", "Group lights", "NAME",
         "Adds the selected lights to a group. The group is created if it does not exist.", "",
         [](Session& s, const Arguments& a) { groupLights(s.editing(), a[0]); }})
      .asks = {.kind = ActionAsk::Kind::name,
               .title = "Group lights",
               .suggested = [](const Session& s) { return activeNode(s.document()).light.group; }};
  r.add({"lights.ungroup", "Ungroup lights", "", "Removes the selected lights from their groups.",
         "", [](Session& s, const Arguments&) { groupLights(s.editing(), ""); },
         [](const Session& s) { return !selectedLights(s.document()).empty(); }});
  r.add({"lights.select_group", "Select group", "NAME", "Selects the lights of a group.", "",
         [](Session& s, const Arguments& a) {
           std::vector<NodeId> ids;
           for (const Node& n : s.document().scene.nodes) {
             if (n.light.group == a[0]) ids.push_back(n.id);
           }
           if (ids.empty() || a[0].empty())
             throw InputError(a[0], "there is no group of lights with this name",
                              "the light table lists them");
           s.select(std::move(ids));
         }});
  addGroupSwitch(r, "lights.mute_group", "Mute group",
                 "Mutes a group of lights, or unmutes it. Lights of a muted group do not emit.",
                 &LightGroup::muted);
  addGroupSwitch(r, "lights.solo_group", "Solo group",
                 "Only the lights of this group and of other solo groups emit.", &LightGroup::solo);
  r.add({"panel.lights", "Light table", "", "Shows a table of all lights, below the view.", "L",
         [](Session& s, const Arguments&) {
           s.lighting().showsTable = !s.lighting().showsTable;
           s.home().bottom = BottomPanel::none;
         },
         nullptr, true, [](const Session& s) { return s.lighting().showsTable; }});
  r.add({"view.work_light", "Work light", "",
         "A lamp at the camera, for dark levels. It is not part of the level and is not saved.",
         "Shift+L", [](Session& s, const Arguments&) { toggleWorkLight(s); }, nullptr, true,
         [](const Session& s) { return s.lighting().workLight > 0.0f; }});
}

}  // namespace lamplighter
