// The lights of a scene, of every kind, and what is theirs whatever carries it: area and punctual
// lights on nodes, emissive materials on meshes, the sky.
#pragma once

#include <vector>

#include "editor/document/document.h"
#include "editor/lights/units.h"

namespace lamplighter {

struct LightSource {
  NodeId node = kNoNode;  // kNoNode: the sky
  size_t index = 0;       // into Scene::nodes
  LightMeasure measure;
};

// In the order of the nodes; the sky last, unless it is black.
std::vector<LightSource> lightsOf(const Scene& scene);
// Those of them that are selected.
std::vector<LightSource> selectedLights(const Document& document);
// Of one node that is a light.
LightMeasure measureOf(const Scene& scene, const Node& node, const mat4& world);

// Radiance, intensity or irradiance, as the kind has it. A mesh: the mean over what emits, textures
// aside; a sky: over the sphere, a picture's scale alone.
vec3 emissionOf(const Scene& scene, const LightSource& light);
const LightState& stateOf(const Scene& scene, const LightSource& light);
// The materials by which a mesh emits, each once.
std::vector<int> emissiveMaterials(const Scene& scene, const Node& node);

}  // namespace lamplighter
