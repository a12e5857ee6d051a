// All lights of a scene, and the properties that lights of every kind have: area and punctual
// lights on nodes, emissive materials on meshes, and the sky.
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

// In node order. The sky is last, unless it is black.
std::vector<LightSource> lightsOf(const Scene& scene);
// The selected ones of these lights.
std::vector<LightSource> selectedLights(const Document& document);
// The measure of a node that is a light.
LightMeasure measureOf(const Scene& scene, const Node& node, const mat4& world);

// Radiance, intensity or irradiance, depending on the kind. Mesh: the mean over the emissive
// surfaces, without textures. Sky: the mean over the sphere; for a picture, only its scale.
vec3 emissionOf(const Scene& scene, const LightSource& light);
const LightState& stateOf(const Scene& scene, const LightSource& light);
// The emissive materials of a mesh, each once.
std::vector<int> emissiveMaterials(const Scene& scene, const Node& node);

}  // namespace lamplighter
