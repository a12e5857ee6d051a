// A room with its texels, depths and links.
#pragma once

#include "renderer/surface_depths/surface_depths.h"
#include "renderer/surface_depths/texel_links.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter::test {

struct RoomTexels {
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  ObjectCharts charts{std::filesystem::path()};
  TexelSet texels;

  // With a box on its floor, or empty.
  explicit RoomTexels(bool hasBox, float texel = 0.25f, TexelOrder order = TexelOrder::zigzag) {
    Scene room;
    addMesh(room, roomMesh(vec3(4.0f, 3.0f, 4.0f), addMaterial(room, vec3(0.7f))));
    if (hasBox)
      addMesh(room, boxMesh(vec3(1.0f), addMaterial(room, vec3(0.5f))), vec3(0.3f, -1.0f, 0.2f));
    scene = renderSceneOf(room);
    rays = std::make_unique<RayCaster>(scene);
    texels = TexelSet(scene, charts.find(scene, 1.0f / texel), order);
  }
  SurfaceDepths depths(const DepthMapLayout& layout) const {
    SurfaceDepths out;
    out.restart(scene, texels, layout);
    while (!out.isDone()) out.goOn(scene, *rays, texels, 10'000'000);
    return out;
  }
};

}  // namespace lamplighter::test
