// Which lights are on: on/off, solo, and groups with mute and solo. It is part of the scene, so it
// is saved and can be undone. Lights that are not on give no light in any method.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/node_id.h"

namespace lamplighter {

struct Scene;

struct LightState {
  bool on = true;
  bool solo = false;  // while any light or group is solo, those that are not are dark
  std::string group;  // name of a LightGroup, or empty
  std::vector<NodeId> leftOut = {};  // sorted; objects that get none of its light (light_linking.h)

  bool operator==(const LightState&) const = default;
};

struct LightGroup {
  std::string name;
  bool muted = false;
  bool solo = false;

  bool operator==(const LightGroup&) const = default;
};

struct ShiningLights {
  std::vector<bool> nodes;  // in the order of Scene::nodes; true for nodes that are not lights
  bool sky = true;

  bool operator==(const ShiningLights&) const = default;
};

// A light shines if it is on and its group is not muted. If any light or group is solo, the light
// or its group must also be solo.
ShiningLights shiningLights(const Scene& scene);
// Whether any light is off, or any light or group is muted or solo.
bool anyLightDark(const Scene& scene);

const LightGroup* findLightGroup(const Scene& scene, const std::string& name);

}  // namespace lamplighter
