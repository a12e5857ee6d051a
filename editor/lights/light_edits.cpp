#include "editor/lights/light_edits.h"

#include <algorithm>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

std::string counted(size_t lights) {
  return lights == 1 ? "a light" : std::to_string(lights) + " lights";
}

std::vector<LightSource> requireLights(const Editing& editing) {
  std::vector<LightSource> lights = selectedLights(editing.document());
  if (lights.empty()) throw InputError("lights", "no light is selected", "select one or more");
  return lights;
}

void put(Editing& editing, const std::string& label, LightEdit changed) {
  Transaction edit = editing.begin(label);
  edit.setNodes(std::move(changed.nodes));
  for (auto& [index, material] : changed.materials) edit.material(index) = std::move(material);
  edit.commit();
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
        "give a value in that range");
  }
}

bool isInUse(const Scene& scene, const LightGroup& group) {
  return scene.skyLight.group == group.name ||
         std::any_of(scene.nodes.begin(), scene.nodes.end(),
                     [&](const Node& n) { return n.light.group == group.name; });
}

}  // namespace

void editLights(Editing& editing, LightOperation operation, LightProperty property, double value,
                LightUnit unit) {
  const std::vector<LightSource> lights = requireLights(editing);
  checkValue(operation, property, value);
  const Scene& scene = editing.document().scene;
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
  put(editing, std::string("Change ") + info.name + " of " + counted(count), std::move(edit));
}

void colourLights(Editing& editing, const vec3& colour) {
  const std::vector<LightSource> lights = requireLights(editing);
  if (!(std::min({colour.r, colour.g, colour.b}) >= 0.0f && luminance(colour) > 0.0f))
    throw InputError("lights.colour",
                     "a colour needs components of at least 0 and must not be black",
                     "give three numbers from 0 to 1");
  LightEdit edit;
  for (const LightSource& light : lights) setColour(editing.document().scene, light, colour, edit);
  put(editing, "Change colour of " + counted(lights.size()), std::move(edit));
}

void editLightStates(Editing& editing, const std::string& label,
                     const std::function<void(LightState&)>& change) {
  std::vector<NodeId> nodes;
  for (const LightSource& light : requireLights(editing)) nodes.push_back(light.node);
  editLightStates(editing, nodes, label, change);
}

void editLightStates(Editing& editing, const std::vector<NodeId>& nodes, const std::string& label,
                     const std::function<void(LightState&)>& change) {
  LightEdit edit;
  for (const NodeId id : nodes) {
    const Node* node = editing.document().scene.find(id);
    if (node == nullptr) continue;
    edit.nodes.push_back(*node);
    change(edit.nodes.back().light);
  }
  const std::string what = label + " " + counted(edit.nodes.size());
  put(editing, what, std::move(edit));
}

void groupLights(Editing& editing, const std::string& name) {
  requireLights(editing);
  if (name.size() > 100) throw InputError("lights.group", "the name is too long", "shorten it");
  Transaction edit = editing.begin(name.empty() ? "Ungroup lights" : "Group lights");
  const Scene& scene = editing.document().scene;
  editLightStates(editing, "Group", [&](LightState& state) { state.group = name; });
  std::vector<LightGroup>& groups = edit.lightGroups();
  if (!name.empty() && findLightGroup(scene, name) == nullptr) groups.push_back({name});
  std::erase_if(groups, [&](const LightGroup& g) { return !isInUse(scene, g); });
  edit.commit();
}

void editLightGroup(Editing& editing, const std::string& label, const std::string& name,
                    const std::function<void(LightGroup&)>& change) {
  Transaction edit = editing.begin(label + " " + name);
  std::vector<LightGroup>& groups = edit.lightGroups();
  const auto it = std::find_if(groups.begin(), groups.end(),
                               [&](const LightGroup& g) { return g.name == name; });
  if (it == groups.end())
    throw InputError(name, "there is no group of lights with this name",
                     "the light table lists them");
  change(*it);
  edit.commit();
}

void editSkyState(Editing& editing, const std::string& label,
                  const std::function<void(LightState&)>& change) {
  Transaction edit = editing.begin(label);
  change(edit.skyLight());
  edit.commit();
}

void shineAll(Editing& editing) {
  Transaction edit = editing.begin("Switch all lights on");
  for (const Node& n : editing.document().scene.nodes) {
    if (n.light.on && !n.light.solo) continue;
    LightState& light = edit.node(n.id).light;
    light.on = true;
    light.solo = false;
  }
  edit.skyLight().on = true;
  edit.skyLight().solo = false;
  for (LightGroup& g : edit.lightGroups()) g.muted = g.solo = false;
  edit.commit();
}

}  // namespace lamplighter
