// A light or a coloured object is dragged. The brightness has no jumps, most light paths are kept,
// and the settled picture equals a fresh render.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Room {
  Scene scene;
  NodeId cube, light;
  // Shows a wall and a strip of the floor, but neither the light nor the cube.
  View view = test::lookAt(vec3(0, 1.5f, -1.5f), vec3(-3, 1.2f, -1.5f), 64, 48, 0.9f);
  Settings settings;

  Room() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    const int red = test::addMaterial(scene, vec3(0.9f, 0.05f, 0.05f));
    test::addMesh(scene, test::roomMesh(vec3(6, 4, 6), white), vec3(0, 2, 0));
    cube = test::addMesh(scene, test::boxMesh(vec3(1), red), vec3(-2.0f, 0.6f, 2.2f));
    light = test::addRectangleLight(scene, vec3(0.5f, 3.8f, 0.5f), vec2(1, 0.8f), vec3(10));
    settings.set("vpls", 600);
    settings.set("bounces", 2);
    settings.set("indirect", std::string("samples"));
    settings.set("updates", 80);
    settings.set("map_resolution", 32);
    settings.set("antialias", 1);
    // Tests light paths and shadow maps only: `naive` uses no visibility database.
    settings.set("technique", std::string("naive"));
  }
};

class Drag : public testing::TestWithParam<std::tuple<bool, int>> {};

TEST_P(Drag, HasNoJumpsAndSettlesToTheFreshPicture) {
  const auto [isLight, maxPaths] = GetParam();
  Room room;
  room.settings.set("max_paths", maxPaths);
  FrameRenderer renderer(makeCpuBackend());
  vec3 last = test::meanOf(
      test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, room.settings)
          .radiance->pixels());
  const auto frame = [&](const SceneChanges& changes) {
    const GiOutput out =
        renderer.render({room.scene, changes, room.view, "many_lights", room.settings});
    const vec3 mean = test::meanOf(out.radiance->pixels());
    // One of the 150 light paths, if it hits near the visible wall, gives 2% of the light in view.
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(mean[i] / last[i], 1.0f, 0.04f);
    last = mean;
    return out;
  };
  for (int step = 0; step < 24; ++step) {
    SCOPED_TRACE(step);
    const Scene before = room.scene;
    room.scene.find(isLight ? room.light : room.cube)->local.translation +=
        isLight ? vec3(-0.05f, 0, 0.03f) : vec3(0, 0, -0.06f);
    const GiOutput out = frame(compare(before, room.scene));
    EXPECT_FALSE(out.settled);
    EXPECT_GT(out.stats.of("paths_kept"),
              (out.stats.of("paths_kept") + out.stats.of("paths_replaced")) / 2);
    if (maxPaths > 0) {
      EXPECT_LE(out.stats.of("paths_walked"), maxPaths);
    }
  }
  GiOutput out;
  for (int frames = 0; !out.settled; ++frames) {
    SCOPED_TRACE("after the drag");
    ASSERT_LT(frames, 100);
    out = frame({});
  }
  FrameRenderer freshRenderer(makeCpuBackend());
  const GiOutput fresh =
      test::renderSettled(freshRenderer, room.scene, SceneChanges::all(), room.view, room.settings);
  EXPECT_TRUE(test::sameBits(out.radiance->pixels(), fresh.radiance->pixels()));
}
INSTANTIATE_TEST_SUITE_P(What, Drag, testing::Combine(testing::Bool(), testing::Values(0, 24)));

// Near the wall, the red cube tints the wall. When the cube is moved back, the picture has its old
// bits.
TEST(Drag, AColouredMoverChangesTheColourOfIndirectLight) {
  Room room;
  FrameRenderer renderer(makeCpuBackend());
  const Image away =
      test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, room.settings)
          .radiance->pixels();
  const auto moveTo = [&](const vec3& place) {
    const Scene before = room.scene;
    room.scene.find(room.cube)->local.translation = place;
    return test::renderSettled(renderer, room.scene, compare(before, room.scene), room.view,
                               room.settings)
        .radiance->pixels();
  };
  const vec3 old = room.scene.find(room.cube)->local.translation;
  const vec3 near = test::meanOf(moveTo(vec3(-2.2f, 0.6f, 0.5f))), far = test::meanOf(away);
  EXPECT_GT(near.r / near.g, 1.02f * far.r / far.g);
  EXPECT_TRUE(test::sameBits(moveTo(old), away));
}

}  // namespace
}  // namespace lamplighter
