// Shadow maps that become finer once nothing else is left to do, on the gl backend.
#include <map>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/asset_room.h"
#include "tests/support/lit_scene.h"
#include "tests/support/render.h"

namespace lamplighter {
namespace {

struct FineMapsGl : test::GlTest, test::AssetRoom {
  Settings settings;

  FineMapsGl() : AssetRoom("pillar_room", 93, 61) {}
  void SetUp() override {
    test::GlTest::SetUp();
    settings.set("vpls", 40);
    settings.set("updates", 16);
    settings.set("antialias", 1);
    settings.set("map_resolution", 32);
    settings.set("settled_map_scale", 4);
  }
  Image directly(int resolution, int scale) const {
    Settings other = settings;
    other.set("map_resolution", resolution);
    other.set("settled_map_scale", scale);
    FrameRenderer fresh(makeGlBackend());
    return test::renderSettled(fresh, scene, SceneChanges::all(), view, other).radiance->pixels();
  }
};

// Lights are summed in another order where some have no map, which rounds otherwise.
constexpr double kRounding = 1e-5;

TEST_F(FineMapsGl, ASettledPictureIsThatOfFineMaps) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    settings.set("technique", std::string(technique));
    const Image picture = directly(32, 4);
    EXPECT_LT(compareImages(picture, directly(128, 1)).relRmse, kRounding);
    EXPECT_GT(compareImages(picture, directly(32, 1)).relRmse, 100 * kRounding);
  }
}

// Of both sizes at a time: each is looked up with its own resolution, as by the cpu backend.
TEST_F(FineMapsGl, OnTheWayItIsAsByTheCpuBackend) {
  for (const char* technique : {"naive", "light_maps"}) {
    SCOPED_TRACE(technique);
    settings.set("technique", std::string(technique));
    // By how many maps are to become fine; a fine map counts as two of the cpu backend's.
    const auto picturesOf = [&](std::unique_ptr<Backend> backend, int updates) {
      settings.set("updates", updates);
      FrameRenderer renderer(std::move(backend));
      std::map<int, Image> pictures;
      GiOutput out = renderer.render({scene, SceneChanges::all(), view, "many_lights", settings});
      while (!out.settled) {
        out = renderer.render({scene, {}, view, "many_lights", settings});
        if (out.stats.of("vpls_pending") == 0 &&
            out.stats.of("maps_to_sharpen") < out.stats.of("maps_held"))
          pictures[static_cast<int>(out.stats.of("maps_to_sharpen"))] = out.radiance->pixels();
      }
      return pictures;
    };
    const auto gl = picturesOf(makeGlBackend(), 4), cpu = picturesOf(makeCpuBackend(), 8);
    EXPECT_GT(gl.size(), 4u);
    ASSERT_EQ(gl.size(), cpu.size());
    for (const auto& [left, picture] : gl) {
      ASSERT_TRUE(cpu.contains(left));
      EXPECT_LT(compareImages(picture, cpu.at(left)).relRmse, 0.005) << left << " to sharpen";
    }
  }
}

// An edit half way, and another once it is settled.
TEST_F(FineMapsGl, AnyWayThereIsThePictureFromNothing) {
  FrameRenderer renderer(makeGlBackend());
  SceneChanges changes = SceneChanges::all();
  for (const int frames : {6, 60, 2}) {
    for (int frame = 0; frame < frames; ++frame) {
      renderer.render({scene, changes, view, "many_lights", settings});
      changes = {};
    }
    const Scene before = scene;
    for (Node& node : scene.nodes)
      if (node.name == "mover") node.local.translation.x += 0.1f;
    changes = compare(before, scene);
  }
  const Image there =
      test::renderSettled(renderer, scene, changes, view, settings).radiance->pixels();
  EXPECT_LT(compareImages(there, directly(32, 4)).relRmse, kRounding);
}

}  // namespace
}  // namespace lamplighter
