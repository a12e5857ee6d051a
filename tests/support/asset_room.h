// A scene from assets/, seen from its own camera.
#pragma once

#include <filesystem>
#include <string>

#include "renderer/scene/camera.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"

namespace lamplighter::test {

struct AssetRoom {
  Scene scene;
  View view;
  AssetRoom(const std::string& name, int width, int height)
      : scene(loadGltf(test::sourceFolder() / "assets/scenes" / (name + ".gltf")).scene) {
    for (const Node& node : scene.nodes)
      if (node.camera != kNone) view = viewOfCamera(scene, node, width, height);
  }
};

}  // namespace lamplighter::test
