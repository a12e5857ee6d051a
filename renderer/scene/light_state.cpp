#include "renderer/scene/light_state.h"

#include <algorithm>

#include "renderer/scene/scene.h"

namespace lamplighter {

namespace {

struct Effective {
  bool on, solo;
};

Effective effective(const Scene& scene, const LightState& state) {
  const LightGroup* group = findLightGroup(scene, state.group);
  return {state.on && !(group && group->muted), state.solo || (group && group->solo)};
}

}  // namespace

const LightGroup* findLightGroup(const Scene& scene, const std::string& name) {
  const auto it = std::find_if(scene.lightGroups.begin(), scene.lightGroups.end(),
                               [&](const LightGroup& g) { return g.name == name; });
  return name.empty() || it == scene.lightGroups.end() ? nullptr : &*it;
}

ShiningLights shiningLights(const Scene& scene) {
  ShiningLights out;
  out.nodes.assign(scene.nodes.size(), true);
  const Effective sky = effective(scene, scene.skyLight);
  std::vector<size_t> soloed;
  bool anySolo = sky.solo && !scene.sky.isBlack();
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    const Effective e = effective(scene, scene.nodes[i].light);
    if (e.on && !e.solo) continue;
    if (!emitsLight(scene, scene.nodes[i])) continue;
    out.nodes[i] = e.on;
    if (e.solo) soloed.push_back(i);
  }
  anySolo |= !soloed.empty();
  out.sky = sky.on && (!anySolo || sky.solo);
  if (!anySolo) return out;
  for (size_t i = 0; i < scene.nodes.size(); ++i) {
    if (!out.nodes[i] || !emitsLight(scene, scene.nodes[i])) continue;
    out.nodes[i] = std::binary_search(soloed.begin(), soloed.end(), i);
  }
  return out;
}

bool anyLightDark(const Scene& scene) {
  const auto dark = [](const LightState& s) { return !s.on || s.solo; };
  return dark(scene.skyLight) ||
         std::any_of(scene.nodes.begin(), scene.nodes.end(),
                     [&](const Node& n) { return dark(n.light); }) ||
         std::any_of(scene.lightGroups.begin(), scene.lightGroups.end(),
                     [](const LightGroup& g) { return g.muted || g.solo; });
}

}  // namespace lamplighter
