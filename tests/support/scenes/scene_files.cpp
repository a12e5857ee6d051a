#include "tests/support/scenes/scene_files.h"

#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter::test {

std::filesystem::path sceneFile(const std::string& name) {
  const bool isAsset = name.find('/') == std::string::npos;
  return (isAsset ? sourceFolder() / "assets/scenes" : sharedScenes()) / name;
}

Scene loadAsset(const std::string& name) { return loadGltf(sceneFile(name + ".gltf")).scene; }

View viewOf(const Scene& scene, int width, int height) {
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) return viewOfCamera(scene, node, width, height);
  return viewOfBounds(renderSceneOf(scene).bounds, width, height);
}

}  // namespace lamplighter::test
