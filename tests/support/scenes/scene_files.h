// Scenes from files for tests, and their views.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter::test {

// The file of a scene: "room.gltf" is in assets/scenes, "folder/level.glb" is a third-party scene,
// which may be missing.
std::filesystem::path sceneFile(const std::string& name);

// The scene assets/scenes/NAME.gltf.
Scene loadAsset(const std::string& name);

// The view of the scene's first camera, or of the whole scene if it has no camera.
View viewOf(const Scene& scene, int width, int height);

// A scene of assets/scenes, seen from its own camera.
struct AssetRoom {
  Scene scene;
  View view;
  AssetRoom(const std::string& name, int width, int height)
      : scene(loadAsset(name)), view(viewOf(scene, width, height)) {}
};

}  // namespace lamplighter::test
