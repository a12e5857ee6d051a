#include "editor/lights/light_edits.h"

#include <algorithm>
#include <cmath>

#include "editor/edits/edits.h"
#include "editor/lights/light_commands.h"
#include "renderer/base/error.h"

namespace lamplighter {

namespace {

std::string counted(size_t lights) {
  return lights == 1 ? "a light" : std::to_string(lights) + " lights";
}

std::vector<LightSource> requireLights(const Editing& editing) {
  std::vector<LightSource> lights = selectedLights(editing.document);
  if (lights.empty()) throw InputError("lights", "no light is selected", "select one or more");
  return lights;
}

// Makes several commands one undo step.
class OneStep {
 public:
  OneStep(const Editing& editing, const std::string& label)
      : history_(editing.history), isOwn_(!editing.history.inTransaction()) {
    if (isOwn_) history_.begin(label);
  }
  ~OneStep() {
    if (isOwn_) history_.commit();
  }

 private:
  History& history_;
  bool isOwn_;
};

void run(const Editing& editing, const std::string& label, LightEdit edit) {
  const OneStep step(editing, label);
  if (!edit.nodes.empty())
    editing.history.run(
        std::make_unique<EditNodes>(label, editing.document, std::move(edit.nodes)));
  for (auto& [index, material] : edit.materials)
    editing.history.run(
        std::make_unique<EditMaterial>(editing.document, index, std::move(material)));
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

void editLights(const Editing& editing, LightOperation operation, LightProperty property,
                double value, LightUnit unit) {
  const std::vector<LightSource> lights = requireLights(editing);
  checkValue(operation, property, value);
  const Scene& scene = editing.document.scene;
  LightEdit edit;
  size_t count = 0;
  for (const LightSource& light : lights) {
    const bool isFactor = operation == LightOperation::multiply;
    const LightUnit own = isFactor ? unitFor(light.measure, unit) : unit;
    const auto now = valueOf(scene, light, property, own);
    double wanted = value;
    if (operation != LightOperation::set) {
      // A colour that is not near a colour temperature has no temperature to change.
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
  run(editing, std::string("Change ") + info.name + " of " + counted(count), std::move(edit));
}

void colourLights(const Editing& editing, const vec3& colour) {
  const std::vector<LightSource> lights = requireLights(editing);
  if (!(std::min({colour.r, colour.g, colour.b}) >= 0.0f && luminance(colour) > 0.0f))
    throw InputError("lights.colour", "a colour has no part below 0 and is not black",
                     "give three numbers from 0 to 1");
  LightEdit edit;
  for (const LightSource& light : lights) setColour(editing.document.scene, light, colour, edit);
  run(editing, "Change colour of " + counted(lights.size()), std::move(edit));
}

void editLightStates(const Editing& editing, const std::string& label,
                     const std::function<void(LightState&)>& change) {
  std::vector<NodeId> nodes;
  for (const LightSource& light : requireLights(editing)) nodes.push_back(light.node);
  editLightStates(editing, nodes, label, change);
}

void editLightStates(const Editing& editing, const std::vector<NodeId>& nodes,
                     const std::string& label, const std::function<void(LightState&)>& change) {
  LightEdit edit;
  for (const NodeId id : nodes) {
    const Node* node = editing.document.scene.find(id);
    if (node == nullptr) continue;
    edit.nodes.push_back(*node);
    change(edit.nodes.back().light);
  }
  const std::string what = label + " " + counted(edit.nodes.size());
  run(editing, what, std::move(edit));
}

void groupLights(const Editing& editing, const std::string& name) {
  requireLights(editing);
  if (name.size() > 100) throw InputError("lights.group", "the name is too long", "shorten it");
  const OneStep step(editing, name.empty() ? "Ungroup lights" : "Group lights");
  const Scene& scene = editing.document.scene;
  std::vector<LightGroup> groups = scene.lightGroups;
  if (!name.empty() && findLightGroup(scene, name) == nullptr) groups.push_back({name});
  editLightStates(editing, "Group", [&](LightState& state) { state.group = name; });
  editing.history.run(std::make_unique<EditLightStates>(editing.document, scene.skyLight,
                                                        groupsInUse(scene, std::move(groups))));
}

void editLightGroup(const Editing& editing, const std::string& label, const std::string& name,
                    const std::function<void(LightGroup&)>& change) {
  std::vector<LightGroup> groups = editing.document.scene.lightGroups;
  const auto it = std::find_if(groups.begin(), groups.end(),
                               [&](const LightGroup& g) { return g.name == name; });
  if (it == groups.end())
    throw InputError(name, "there is no group of lights of that name", "look in the light table");
  change(*it);
  const OneStep step(editing, label + " " + name);
  editing.history.run(std::make_unique<EditLightStates>(
      editing.document, editing.document.scene.skyLight, std::move(groups)));
}

void editSkyState(const Editing& editing, const std::string& label,
                  const std::function<void(LightState&)>& change) {
  LightState state = editing.document.scene.skyLight;
  change(state);
  const OneStep step(editing, label);
  editing.history.run(std::make_unique<EditLightStates>(editing.document, std::move(state),
                                                        editing.document.scene.lightGroups));
}

void shineAll(const Editing& editing) {
  LightEdit edit;
  for (const Node& n : editing.document.scene.nodes) {
    if (n.light.on && !n.light.solo) continue;
    edit.nodes.push_back(n);
    edit.nodes.back().light.on = true;
    edit.nodes.back().light.solo = false;
  }
  LightState sky = editing.document.scene.skyLight;
  sky.on = true;
  sky.solo = false;
  std::vector<LightGroup> groups = editing.document.scene.lightGroups;
  for (LightGroup& g : groups) g.muted = g.solo = false;
  const OneStep step(editing, "Switch all lights on");
  run(editing, "Switch all lights on", std::move(edit));
  editing.history.run(
      std::make_unique<EditLightStates>(editing.document, std::move(sky), std::move(groups)));
}

}  // namespace lamplighter
