// Fine shadow maps, which replace coarse ones when the picture has settled otherwise, on the gl
// backend.
#include <map>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

struct FineMapsGl : test::GlTest, test::AssetRoom {
  Settings settings;

  FineMapsGl() : AssetRoom("pillar_room", 93, 61) {}
  void SetUp() override {
    test::GlTest::SetUp();
    settings.set("vpls", 40);
    settings.set("indirect", std::string("samples"));
    settings.set("updates", 16);
    settings.set("antialias", 1);
    settings.set("map_resolution", 32);
    settings.set("settled_map_scale", 4);
  }
  Image freshPicture(int resolution, int scale) const {
    Settings other = settings;
    other.set("map_resolution", resolution);
    other.set("settled_map_scale", scale);
    return test::freshPicture(makeGlBackend(), scene, view, other);
  }
};

// Lights without a shadow map are summed in another order, which rounds differently.
constexpr double kRounding = 1e-5;

TEST_F(FineMapsGl, ASettledPictureUsesFineMaps) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    settings.set("technique", std::string(technique));
    const Image picture = freshPicture(32, 4);
    EXPECT_LT(compareImages(picture, freshPicture(128, 1)).relRmse, kRounding);
    EXPECT_GT(compareImages(picture, freshPicture(32, 1)).relRmse, 100 * kRounding);
  }
}

// While maps of both sizes exist, each is looked up with its own resolution, as on the cpu backend.
TEST_F(FineMapsGl, WithMixedSizesThePictureEqualsTheCpuBackend) {
  for (const char* technique : {"naive", "light_maps"}) {
    SCOPED_TRACE(technique);
    settings.set("technique", std::string(technique));
    // Pictures by the number of maps that are still coarse. A fine map costs twice as much of the
    // budget on the cpu backend.
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

// One edit while maps are replaced, and another after the picture has settled.
TEST_F(FineMapsGl, AfterEditsThePictureEqualsAFreshRender) {
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
  const Image edited =
      test::renderSettled(renderer, scene, changes, view, settings).radiance->pixels();
  EXPECT_LT(compareImages(edited, freshPicture(32, 4)).relRmse, kRounding);
}

}  // namespace
}  // namespace lamplighter
