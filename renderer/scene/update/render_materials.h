// The materials of a RenderScene and the textures that they use, from those of the document.
#pragma once

#include <vector>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

struct RenderMaterials {
  RenderMaterials() = default;
  // `shining`: by node, whether its light shines (light_state.h).
  RenderMaterials(const Scene& scene, const std::vector<bool>& shining);

  // As in RenderScene.
  std::vector<Material> materials;
  std::vector<vec3> nominalEmission;
  std::vector<Texture> textures;
  int firstDark = 0;
  std::vector<int> ofAreaLight;  // by node: index of its material, or kNone
};

// Index of a primitive's material, lit or dark.
int materialOf(const Scene& scene, const Primitive& primitive, bool shines, int firstDark);

// A material before and after a change, with its emission while its light is on.
struct MaterialState {
  const Material& material;
  vec3 nominalEmission;
};
// Adds to `out` the changes of the material with this index. A change of emission alone is noted as
// such if the material is the surface of an area light, which reflects nothing, or emits before and
// after; otherwise the material has changed.
void noteMaterial(const MaterialState& before, const MaterialState& now, int index,
                  bool isOfAreaLight, RenderSceneChanges& out);

// Replaces the materials of the scene, in the same order and number as before.
void takeMaterials(RenderScene& render, RenderMaterials now, RenderSceneChanges& out);

}  // namespace lamplighter
