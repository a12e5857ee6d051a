// Which shadow maps a view looks up.
#include "renderer/visibility/shadow_map_demand.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/raycast/ray_caster.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Room : test::AssetRoom {
  RenderScene world = test::renderSceneOf(scene);
  VisibilityDatabase visibility;

  explicit Room(const char* name) : AssetRoom(name, 64, 48) {
    std::vector<shared::Vpl> lights = test::lightsOf(world, 60);
    for (size_t i = 0; i < lights.size(); ++i) lights[i].slot = static_cast<int>(i);
    visibility.setScene(world, test::everythingRebuilt());
    visibility.setLights(world, lights);
  }
};

// By slot: whether the light is partial at a pixel of the view.
std::vector<uint8_t> partialAtPixels(const Room& room) {
  const RayCaster rays(room.world);
  std::vector<uint8_t> partial(room.visibility.slots(), 0);
  for (int y = 0; y < room.view.height; ++y) {
    for (int x = 0; x < room.view.width; ++x) {
      const Ray ray{
          room.view.eye, 0.0f,
          room.view.rayDirection(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f)};
      const Hit hit = rays.intersect(ray, Surfaces::seen);
      if (!hit) continue;
      const int leaf = room.visibility.patches(hit.object)
                           .leafAt(hit.triangle, ray.origin + hit.t * ray.direction);
      const auto states = room.visibility.row(hit.object, leaf);
      for (size_t slot = 0; slot < states.size(); ++slot)
        partial[slot] |= states[slot] == static_cast<uint8_t>(Occlusion::partial) ? 1 : 0;
    }
  }
  return partial;
}

// For six directions of the camera, no light that a pixel looks up is missing. Outside the scene
// none is found.
TEST(SeenLights, IncludeAllLightsThatPixelsLookUp) {
  size_t found = 0, looked = 0, asked = 0;
  for (const char* name : {"pillar_room", "area_light_room", "table_room", "default"}) {
    Room room(name);
    const quat initial = room.view.orientation;
    for (int turn = 0; turn < 6; ++turn) {
      room.view.orientation =
          glm::angleAxis(1.05f * static_cast<float>(turn), vec3(0, 1, 0)) * initial;
      const std::vector<uint8_t> seen = shadowMapDemand(room.visibility, room.world, room.view);
      const std::vector<uint8_t> partial = partialAtPixels(room);
      for (size_t slot = 0; slot < partial.size(); ++slot)
        ASSERT_GE(seen[slot], partial[slot]) << name << ", turn " << turn << ", slot " << slot;
      found += static_cast<size_t>(std::count(seen.begin(), seen.end(), 1));
      looked += static_cast<size_t>(std::count(partial.begin(), partial.end(), 1));
      asked += seen.size();
    }
    room.view.eye.y += 1000.0f;
    const std::vector<uint8_t> none = shadowMapDemand(room.visibility, room.world, room.view);
    EXPECT_EQ(std::count(none.begin(), none.end(), 1), 0) << name;
  }
  EXPECT_GT(looked, 0u);
  EXPECT_LT(found, asked);
}

}  // namespace
}  // namespace lamplighter
