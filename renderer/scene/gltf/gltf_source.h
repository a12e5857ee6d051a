// What is kept of a file that a scene came from, so that saving can patch it. For gltf_*.cpp only.
#pragma once

#include <memory>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

class SceneSource {
 public:
  GltfDocument document;
  // As loaded: what is the same in the scene that is saved is written as it was.
  std::vector<std::shared_ptr<const Mesh>> meshes;
  std::vector<Texture> textures;
  std::vector<Node> nodes;
  Sky sky;
  bool skyIsDefault = false;
  LightState skyLight;
  std::vector<LightGroup> lightGroups;
  std::vector<CameraBookmark> bookmarks;
};

}  // namespace lamplighter
