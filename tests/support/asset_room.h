// One of our own scenes, seen through its camera.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/gltf_io.h"
#include "renderer/view.h"

namespace lamplighter::test {

struct AssetRoom {
  Scene scene;
  View view;
  AssetRoom(const std::string& name, int width, int height)
      : scene(loadGltf(std::filesystem::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes" /
                       (name + ".gltf"))
                  .scene) {
    for (const Node& node : scene.nodes)
      if (node.camera != kNone) view = viewOfCamera(scene, node, width, height);
  }
};

}  // namespace lamplighter::test
