// The low-resolution pass on the gl backend. It is close to the full-resolution picture, gives the
// same bits for any number of lights per pass, and leaks no light past objects thinner than a
// block.
#include <filesystem>
#include <ostream>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

Settings settingsOf(int block, const std::string& technique = "light_maps", int vpls = 150,
                    int lightsPerPass = 1024) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("updates", vpls);
  s.set("antialias", 1);
  s.set("lights_per_pass", lightsPerPass);
  s.set("block", std::to_string(block));
  return s;
}

// A point light. Its shadows are hard.
void addLamp(Scene& scene) {
  const NodeId id = test::addNode(scene, "lamp", kNoNode, vec3(0.4f, 2.0f, 0.3f));
  PunctualLight lamp;
  lamp.intensity = vec3(60.0f);
  scene.find(id)->punctual = lamp;
}

// Share of the pixels whose bits differ.
double differingShare(const Image& a, const Image& b) {
  size_t other = 0;
  for (size_t i = 0; i < a.pixels.size(); ++i) other += a.pixels[i] != b.pixels[i];
  return static_cast<double>(other) / static_cast<double>(a.pixels.size());
}

struct Case {
  const char* scene;
  double mostRelRmse = 0.015;
  double leastShare =
      0.03;       // minimum share of interpolated pixels; with fewer the test proves nothing
  int scale = 1;  // of the picture: small surfaces have no entries, so that sunlight is not
                  // interpolated on them
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class GlLowResolutionScenes : public test::GlTest, public testing::WithParamInterface<Case> {};

TEST_P(GlLowResolutionScenes, IsCloseToFullResolution) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const View view = test::viewOf(scene, 318 * GetParam().scale,
                                 211 * GetParam().scale);  // not a multiple of any block size
  for (const std::string technique : {"visibility", "light_maps"}) {
    const Image all = test::freshPicture(makeGlBackend(), scene, view, settingsOf(1, technique));
    for (const int block : {2, 4, 8}) {
      SCOPED_TRACE(technique + " " + std::to_string(block));
      const Image low =
          test::freshPicture(makeGlBackend(), scene, view, settingsOf(block, technique));
      const Metrics m = compareImages(low, all);
      const double share = differingShare(low, all);
      RecordProperty(technique + std::to_string(block),
                     std::to_string(m.relRmse) + ", interpolated " + std::to_string(share));
      EXPECT_LT(m.relRmse, GetParam().mostRelRmse);
      EXPECT_NEAR(m.bias, 1.0, 0.002);
      EXPECT_GT(share, GetParam().leastShare);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, GlLowResolutionScenes,
    testing::Values(Case{"area_light_room.gltf"}, Case{"pillar_room.gltf"},
                    Case{"cornell_style.gltf"}, Case{"modern-hall/modern-hall.glb", 0.03},
                    Case{"kenney-fps-level/kenney-fps-level.gltf", 0.015, 0.005, 3}));

using GlLowResolution = test::GlTest;

TEST_F(GlLowResolution, TheNumberOfLightsPerPassDoesNotChangeBits) {
  const Scene scene = test::loadAsset("pillar_room");
  const View view = test::viewOf(scene, 161, 97);
  const Image all =
      test::freshPicture(makeGlBackend(), scene, view, settingsOf(4, "light_maps", 60));
  for (const int most : {1, 7}) {
    EXPECT_TRUE(test::sameBits(all, test::freshPicture(makeGlBackend(), scene, view,
                                                       settingsOf(4, "light_maps", 60, most))))
        << most;
  }
}

TEST_F(GlLowResolution, MergedPassesGiveThePictureOfLightLists) {
  const Scene scene = test::loadAsset("pillar_room");
  const View view = test::viewOf(scene, 161, 97);
  Settings settings = settingsOf(4, "light_maps", 60, 6);
  const Image listed = test::freshPicture(makeGlBackend(), scene, view, settings);
  settings.set("merge_passes", true);
  // Floats are summed in another order. A cell close to the contrast threshold may be classified
  // differently.
  EXPECT_LT(
      compareImages(test::freshPicture(makeGlBackend(), scene, view, settings), listed).relRmse,
      1e-3);
}

// Both backends use the same definition of cells. Their cells differ only where a pixel sees past
// an edge on one backend, or close to the contrast threshold.
TEST_F(GlLowResolution, InterpolatesTheSameCellsAsTheCpuBackend) {
  for (const bool hasLamp : {false, true}) {
    SCOPED_TRACE(hasLamp);
    Scene scene = test::loadAsset(hasLamp ? "pillar_room" : "area_light_room");
    if (hasLamp) addLamp(scene);
    const View view = test::viewOf(scene, 161, 97);
    Image interpolated[2];
    for (const int i : {0, 1}) {
      const auto make = [&] { return i == 0 ? makeGlBackend() : makeCpuBackend(); };
      const Image low = test::freshPicture(make(), scene, view, settingsOf(4));
      const Image all = test::freshPicture(make(), scene, view, settingsOf(1));
      interpolated[i] = Image(low.width, low.height);
      for (size_t p = 0; p < low.pixels.size(); ++p)
        interpolated[i].pixels[p] = vec3(low.pixels[p] != all.pixels[p] ? 1.0f : 0.0f);
    }
    const double share = differingShare(interpolated[0], interpolated[1]);
    RecordProperty(hasLamp ? "lamp" : "room", std::to_string(share));
    EXPECT_GT(test::meanOf(interpolated[0]).r, hasLamp ? 0.02f : 0.3f);
    EXPECT_LT(share, 0.01);
  }
}

// Samples and cells at the right and lower edges, pictures without any cell, and textures that are
// created again.
TEST_F(GlLowResolution, WorksForAnyPictureSize) {
  const Scene scene = test::loadAsset("area_light_room");
  FrameRenderer renderer(makeGlBackend());
  for (const glm::ivec2 size :
       {glm::ivec2(1, 1), glm::ivec2(1, 40), glm::ivec2(40, 1), glm::ivec2(2, 2), glm::ivec2(5, 4),
        glm::ivec2(64, 64), glm::ivec2(65, 33), glm::ivec2(63, 35)}) {
    const View view = test::viewOf(scene, size.x, size.y);
    const Image all = test::settledPicture(renderer, scene, SceneChanges::all(), view,
                                           settingsOf(1, "light_maps", 40));
    for (const int block : {2, 4, 8}) {
      SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + " by " +
                   std::to_string(block));
      const Image low = test::settledPicture(renderer, scene, SceneChanges::all(), view,
                                             settingsOf(block, "light_maps", 40));
      EXPECT_LT(compareImages(low, all).relRmse, 0.03);
      if (size.x == 1 || size.y == 1) {
        EXPECT_TRUE(test::sameBits(low, all));
      }
      EXPECT_TRUE(test::sameBits(low, test::freshPicture(makeGlBackend(), scene, view,
                                                         settingsOf(block, "light_maps", 40))));
    }
  }
}

// While the camera moves, samples are interpolated as well. The picture then does not depend on
// earlier frames. It is close to the settled picture, which equals a fresh render.
TEST_F(GlLowResolution, WhileTheCameraMovesThePictureIsCloseToTheSettledOne) {
  for (const std::string name : {"area_light_room", "table_room", "pillar_room"}) {
    SCOPED_TRACE(name);
    Scene scene = test::loadAsset(name);
    if (name == "pillar_room") addLamp(scene);
    Settings settings = settingsOf(4);
    settings.set("importance", 1);  // importance does not choose other light samples
    settings.set("settled_map_scale", 1);
    settings.set("bias_compensation", false);
    const View view = test::viewOf(scene, 318, 211);
    View from[2] = {view, view};
    from[0].eye += vec3(0.02f, 0.01f, 0.0f);
    from[1].eye += vec3(-0.3f, 0.1f, 0.2f);
    FrameRenderer renderers[2] = {FrameRenderer(makeGlBackend()), FrameRenderer(makeGlBackend())};
    Image moving[2], settled[2];
    for (const int i : {0, 1}) {
      test::settledPicture(renderers[i], scene, SceneChanges::all(), from[i], settings);
      const GiOutput out = renderers[i].render({scene, {}, view, "many_lights", settings});
      EXPECT_FALSE(out.settled);
      moving[i] = out.radiance->pixels();
      settled[i] = test::settledPicture(renderers[i], scene, {}, view, settings);
    }
    EXPECT_TRUE(test::sameBits(moving[0], moving[1]));
    EXPECT_TRUE(test::sameBits(settled[0], settled[1]));
    EXPECT_TRUE(
        test::sameBits(settled[0], test::freshPicture(makeGlBackend(), scene, view, settings)));
    const Metrics m = compareImages(moving[0], settled[0]);
    RecordProperty(name, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.01);
    EXPECT_GT(m.relRmse, 0.0);
    EXPECT_NEAR(m.bias, 1.0, 0.001);
  }
}

TEST_F(GlLowResolution, NaiveSumsAllPixels) {
  const Scene scene = test::loadAsset("pillar_room");
  const View view = test::viewOf(scene, 96, 64);
  EXPECT_TRUE(
      test::sameBits(test::freshPicture(makeGlBackend(), scene, view, settingsOf(4, "naive", 40)),
                     test::freshPicture(makeGlBackend(), scene, view, settingsOf(1, "naive", 40))));
}

// A wall between two rooms, seen from above and thinner than a block. Its upper edge gets no direct
// light, while the floor on both sides is bright and even. If cells checked only their corners,
// light of the floor would leak onto the wall. With a dark second room, light would leak from one
// room to the other.
TEST_F(GlLowResolution, NothingLeaksPastAThinWall) {
  for (const float other : {30.0f, 0.3f}) {
    Scene scene;
    const int white = test::addMaterial(scene, vec3(0.7f));
    test::addMesh(scene, test::squareMesh(16.0f, white));
    test::addMesh(scene, test::boxMesh(vec3(0.02f, 6.0f, 16.0f), white), vec3(0.0f, 3.0f, 0.0f));
    test::addRectangleLight(scene, vec3(-4.5f, 5, 0), vec2(2.0f), vec3(30.0f));
    test::addRectangleLight(scene, vec3(4.5f, 5, 0), vec2(2.0f), vec3(other));
    const View view = test::lookAt(vec3(0.0f, 10.0f, 0.5f), vec3(0.0f), 323, 203);
    for (const std::string technique : {"visibility", "light_maps"}) {
      SCOPED_TRACE(technique + " " + std::to_string(other));
      const Image all =
          test::freshPicture(makeGlBackend(), scene, view, settingsOf(1, technique, 80));
      for (const int block : {4, 8}) {
        const Image low =
            test::freshPicture(makeGlBackend(), scene, view, settingsOf(block, technique, 80));
        EXPECT_GT(differingShare(low, all), 0.05);
        // The largest error of any pixel: a line of leaked light covers too few pixels to change
        // the mean.
        double worst = 0.0;
        for (size_t i = 0; i < all.pixels.size(); ++i) {
          const double d = std::abs(double{low.pixels[i].g} - double{all.pixels[i].g});
          worst = std::max(worst, d / (double{all.pixels[i].g} + 1e-3));
        }
        RecordProperty(technique + std::to_string(block), std::to_string(worst));
        EXPECT_LT(worst, 0.1);
      }
    }
  }
}

}  // namespace
}  // namespace lamplighter
