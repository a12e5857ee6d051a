#include "editor/lights/light_profile.h"

#include "editor/lights/light_list.h"

namespace lamplighter {

bool takesProfile(const Node& node) {
  return node.punctual && node.punctual->kind != PunctualKind::directional;
}

PunctualLight withProfile(const Scene& scene, const Node& node,
                          std::shared_ptr<const IesProfile> profile) {
  Node with = node;
  with.punctual->profile = std::move(profile);
  const auto lumens = [&](const Node& n) {
    return unitsPerRadiance(measureOf(scene, n, worldMatrix(scene, n.id)), LightUnit::lumens);
  };
  // A lamp without output at this tilt keeps its intensity.
  if (lumens(node) > 0.0 && lumens(with) > 0.0)
    with.punctual->intensity *= static_cast<float>(lumens(node) / lumens(with));
  return *with.punctual;
}

}  // namespace lamplighter
