#include "editor/lights/light_edits.h"

#include <algorithm>
#include <cmath>

#include "editor/commands/edits.h"
#include "editor/lights/light_commands.h"
#include "editor/session.h"
#include "renderer/error.h"

namespace lamplighter {

namespace {

std::string counted(size_t lights) {
  return lights == 1 ? "a light" : std::to_string(lights) + " lights";
}

std::vector<LightSource> requireLights(const Session& s) {
  std::vector<LightSource> lights = selectedLights(s.document());
  if (lights.empty()) throw InputError("lights", "no light is selected", "select one or more");
  return lights;
}

// Several commands as one step.
class OneStep {
 public:
  OneStep(Session& s, const std::string& label)
      : history_(s.history()), isOwn_(!s.history().inTransaction()) {
    if (isOwn_) history_.begin(label);
  }
  ~OneStep() {
    if (isOwn_) history_.commit();
  }

 private:
  History& history_;
  bool isOwn_;
};

void run(Session& s, const std::string& label, LightEdit edit) {
  const OneStep step(s, label);
  if (!edit.nodes.empty())
    s.history().run(std::make_unique<EditNodes>(label, s.document(), std::move(edit.nodes)));
  for (auto& [index, material] : edit.materials)
    s.history().run(std::make_unique<EditMaterial>(s.document(), index, std::move(material)));
}

void checkValue(LightOperation operation, LightProperty property, double value) {
  const LightPropertyInfo& info = lightPropertyInfo(property);
  if (operation == LightOperation::multiply && !(value >= 0.0 && value <= 1e6))
    throw InputError("lights.multiply", "a factor must be from 0 to 1e6", "give one such as 2");
  if (operation != LightOperation::set) return;
  if (!(value >= info.least && value <= info.most)) {
    const auto number = [](double v) {
      std::string text = std::to_string(v);
      text.erase(text.find_last_not_of('0') + 1);
      if (text.back() == '.') text.pop_back();
      return text;
    };
    throw InputError(
        "lights.set",
        std::string(info.name) + " must be from " + number(info.least) + " to " + number(info.most),
        "give such a value");
  }
}

std::vector<LightGroup> groupsInUse(const Scene& scene, std::vector<LightGroup> groups) {
  std::erase_if(groups, [&](const LightGroup& g) {
    return scene.skyLight.group != g.name &&
           std::none_of(scene.nodes.begin(), scene.nodes.end(),
                        [&](const Node& n) { return n.light.group == g.name; });
  });
  return groups;
}

}  // namespace

void editLights(Session& s, LightOperation operation, LightProperty property, double value,
                LightUnit unit) {
  const std::vector<LightSource> lights = requireLights(s);
  checkValue(operation, property, value);
  const Scene& scene = s.document().scene;
  LightEdit edit;
  size_t count = 0;
  for (const LightSource& light : lights) {
    const bool isFactor = operation == LightOperation::multiply;
    const LightUnit own = isFactor ? unitFor(light.measure, unit) : unit;
    const auto now = valueOf(scene, light, property, own);
    double wanted = value;
    if (operation != LightOperation::set) {
      // Light of a colour that is no temperature has none to be changed.
      if (!now) continue;
      wanted = isFactor ? *now * value : *now + value;
    }
    count += setValue(scene, light, property, own, wanted, edit);
  }
  const LightPropertyInfo& info = lightPropertyInfo(property);
  if (count == 0) {
    const bool byUnit = property == LightProperty::intensity;
    throw InputError("lights",
                     byUnit ? std::string("no selected light is measured in ") + unitSymbol(unit)
                            : std::string("no selected light has the property ") + info.name,
                     byUnit ? "give another unit" : "select others");
  }
  run(s, std::string("Change ") + info.name + " of " + counted(count), std::move(edit));
}

void colourLights(Session& s, const vec3& colour) {
  const std::vector<LightSource> lights = requireLights(s);
  if (!(std::min({colour.r, colour.g, colour.b}) >= 0.0f && luminance(colour) > 0.0f))
    throw InputError("lights.colour", "a colour has no part below 0 and is not black",
                     "give three numbers from 0 to 1");
  LightEdit edit;
  for (const LightSource& light : lights) setColour(s.document().scene, light, colour, edit);
  run(s, "Change colour of " + counted(lights.size()), std::move(edit));
}

void editLightStates(Session& s, const std::string& label,
                     const std::function<void(LightState&)>& change) {
  std::vector<NodeId> nodes;
  for (const LightSource& light : requireLights(s)) nodes.push_back(light.node);
  editLightStates(s, nodes, label, change);
}

void editLightStates(Session& s, const std::vector<NodeId>& nodes, const std::string& label,
                     const std::function<void(LightState&)>& change) {
  LightEdit edit;
  for (const NodeId id : nodes) {
    const Node* node = s.document().scene.find(id);
    if (node == nullptr) continue;
    edit.nodes.push_back(*node);
    change(edit.nodes.back().light);
  }
  const std::string what = label + " " + counted(edit.nodes.size());
  run(s, what, std::move(edit));
}

void groupLights(Session& s, const std::string& name) {
  requireLights(s);
  if (name.size() > 100) throw InputError("lights.group", "the name is too long", "shorten it");
  const OneStep step(s, name.empty() ? "Ungroup lights" : "Group lights");
  const Scene& scene = s.document().scene;
  std::vector<LightGroup> groups = scene.lightGroups;
  if (!name.empty() && findLightGroup(scene, name) == nullptr) groups.push_back({name});
  editLightStates(s, "Group", [&](LightState& state) { state.group = name; });
  s.history().run(std::make_unique<EditLightStates>(s.document(), scene.skyLight,
                                                    groupsInUse(scene, std::move(groups))));
}

void editLightGroup(Session& s, const std::string& label, const std::string& name,
                    const std::function<void(LightGroup&)>& change) {
  std::vector<LightGroup> groups = s.document().scene.lightGroups;
  const auto it = std::find_if(groups.begin(), groups.end(),
                               [&](const LightGroup& g) { return g.name == name; });
  if (it == groups.end())
    throw InputError(name, "there is no group of lights of that name", "look in the light table");
  change(*it);
  const OneStep step(s, label + " " + name);
  s.history().run(std::make_unique<EditLightStates>(s.document(), s.document().scene.skyLight,
                                                    std::move(groups)));
}

void editSkyState(Session& s, const std::string& label,
                  const std::function<void(LightState&)>& change) {
  LightState state = s.document().scene.skyLight;
  change(state);
  const OneStep step(s, label);
  s.history().run(std::make_unique<EditLightStates>(s.document(), std::move(state),
                                                    s.document().scene.lightGroups));
}

void shineAll(Session& s) {
  LightEdit edit;
  for (const Node& n : s.document().scene.nodes) {
    if (n.light.on && !n.light.solo) continue;
    edit.nodes.push_back(n);
    edit.nodes.back().light.on = true;
    edit.nodes.back().light.solo = false;
  }
  LightState sky = s.document().scene.skyLight;
  sky.on = true;
  sky.solo = false;
  std::vector<LightGroup> groups = s.document().scene.lightGroups;
  for (LightGroup& g : groups) g.muted = g.solo = false;
  const OneStep step(s, "Switch all lights on");
  run(s, "Switch all lights on", std::move(edit));
  s.history().run(
      std::make_unique<EditLightStates>(s.document(), std::move(sky), std::move(groups)));
}

}  // namespace lamplighter
