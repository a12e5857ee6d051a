// The source file of a scene, kept so that saving can patch it. For gltf_*.cpp only.
#pragma once

#include <memory>
#include <vector>

#include "renderer/scene/gltf/gltf_document.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

class SceneSource {
 public:
  GltfDocument document;
  // The scene as loaded. Parts that are still equal when saving are written unchanged.
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
