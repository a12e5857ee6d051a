// Which lights shine: on and off, solo, and groups that are muted or solo together. Part of the
// scene, so that it is saved and undone; what does not shine gives no light in any method.
#pragma once

#include <string>
#include <vector>

#include "renderer/scene/node_id.h"

namespace lamplighter {

struct Scene;

struct LightState {
  bool on = true;
  bool solo = false;                 // while anything is solo, nothing else shines
  std::string group;                 // a LightGroup's name, or empty
  std::vector<NodeId> leftOut = {};  // objects that get none of its light (light_linking.h); sorted

  bool operator==(const LightState&) const = default;
};

struct LightGroup {
  std::string name;
  bool muted = false;
  bool solo = false;

  bool operator==(const LightGroup&) const = default;
};

struct ShiningLights {
  std::vector<bool> nodes;  // in the order of Scene::nodes; true for what is no light
  bool sky = true;

  bool operator==(const ShiningLights&) const = default;
};

// A light shines when it is on, its group is not muted and, if any light or any light's group is
// solo, it is or its group is.
ShiningLights shiningLights(const Scene& scene);
// Whether anything is off, muted or solo.
bool anyLightDark(const Scene& scene);

const LightGroup* findLightGroup(const Scene& scene, const std::string& name);

}  // namespace lamplighter
