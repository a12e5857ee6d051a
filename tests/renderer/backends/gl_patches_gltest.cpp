// Patches and light maps on the gl backend. The techniques `visibility` and `light_maps` give the
// picture of `naive` and of the cpu backend for any number of lights per pass, and the result does
// not depend on earlier edits.
#include <filesystem>
#include <ostream>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 192, kHeight = 128;

Settings settingsOf(const std::string& technique, int vpls, int lightsPerPass = 1024) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("indirect", std::string("samples"));
  s.set("vpls", vpls);
  s.set("updates", 150);
  s.set("antialias", 1);
  s.set("block", std::string("1"));
  s.set("lights_per_pass", lightsPerPass);
  return s;
}

Image rendered(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
               const Settings& settings) {
  return test::settledPicture(renderer, scene, changes, test::viewOf(scene, kWidth, kHeight),
                              settings);
}

Image rendered(std::unique_ptr<Backend> backend, const Scene& scene, const Settings& settings) {
  FrameRenderer renderer(std::move(backend));
  return rendered(renderer, scene, SceneChanges::all(), settings);
}

struct Case {
  const char* scene;
  int vpls;
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class GlPatchesScenes : public test::GlTest, public testing::WithParamInterface<Case> {};

TEST_P(GlPatchesScenes, EachTechniqueGivesThePictureOfNaiveAndOfTheCpuBackend) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  const int vpls = GetParam().vpls;
  const Image naive = rendered(makeGlBackend(), scene, settingsOf("naive", vpls));
  const Image cpuNaive = rendered(makeCpuBackend(), scene, settingsOf("naive", vpls));
  const double backends = compareImages(naive, cpuNaive).relRmse;
  RecordProperty("naiveFromCpu", std::to_string(backends));
  for (const std::string technique : {"visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    const Image fast = rendered(makeGlBackend(), scene, settingsOf(technique, vpls));
    const Image cpu = rendered(makeCpuBackend(), scene, settingsOf(technique, vpls));
    const Metrics fromNaive = compareImages(fast, naive), fromCpu = compareImages(fast, cpu);
    RecordProperty(technique + "FromNaive", std::to_string(fromNaive.relRmse));
    RecordProperty(technique + "FromCpu", std::to_string(fromCpu.relRmse));
    EXPECT_LT(fromNaive.relRmse, 0.01);
    // Silhouettes of light sources differ more than that in some levels, with `naive` as well.
    EXPECT_LT(fromCpu.relRmse, std::max(0.01, 1.02 * backends));
    EXPECT_NEAR(fromNaive.bias, 1.0, 0.005);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, GlPatchesScenes,
    testing::Values(Case{"default.gltf", 300}, Case{"area_light_room.gltf", 300},
                    Case{"table_room.gltf", 300}, Case{"pillar_room.gltf", 300},
                    Case{"cornell_style.gltf", 300}, Case{"modern-hall/modern-hall.glb", 100},
                    Case{"kenney-fps-level/kenney-fps-level.gltf", 100},
                    Case{"lights-punctual/gltf_KHR_lights_punctual_test.glb", 100},
                    Case{"flight-helmet/FlightHelmet.gltf", 30}));

using GlPatches = test::GlTest;

// If the techniques gave the picture of `naive`, the comparisons in this file would prove nothing.
TEST_F(GlPatches, TechniquesGiveDifferentBits) {
  const Scene scene = test::loadAsset("pillar_room");
  const Image naive = rendered(makeGlBackend(), scene, settingsOf("naive", 100));
  const Image visibility = rendered(makeGlBackend(), scene, settingsOf("visibility", 100));
  const Image lightMaps = rendered(makeGlBackend(), scene, settingsOf("light_maps", 100));
  EXPECT_FALSE(test::sameBits(visibility, naive));
  EXPECT_FALSE(test::sameBits(lightMaps, naive));
  EXPECT_FALSE(test::sameBits(lightMaps, visibility));
}

TEST_F(GlPatches, TheNumberOfLightsPerPassDoesNotChangeBits) {
  const Scene scene = test::loadAsset("table_room");
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    FrameRenderer renderer(makeGlBackend());
    const Image all = rendered(renderer, scene, SceneChanges::all(), settingsOf(technique, 60));
    for (const int most : {1, 4, 59}) {
      EXPECT_TRUE(
          test::sameBits(all, rendered(makeGlBackend(), scene, settingsOf(technique, 60, most))))
          << most;
    }
  }
}

TEST_F(GlPatches, AfterEditsThePictureEqualsAFreshRender) {
  for (const char* technique : {"visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    Scene scene = test::loadAsset("pillar_room");
    const Settings settings = settingsOf(technique, 120);
    FrameRenderer renderer(makeGlBackend());
    const Image first = rendered(renderer, scene, SceneChanges::all(), settings);
    int moved = 0;
    for (Node& node : scene.nodes) {
      if (node.name != "mover" && node.name != "ceiling light") continue;
      const Scene before = scene;
      node.local.translation += vec3(0.7f, 0.0f, 0.3f);
      const Image edited = rendered(renderer, scene, compare(before, scene), settings);
      const Image fresh = rendered(makeGlBackend(), scene, settings);
      EXPECT_TRUE(test::sameBits(edited, fresh)) << node.name;
      EXPECT_GT(compareImages(edited, first).relRmse, 0.01) << node.name;
      ++moved;
    }
    EXPECT_EQ(moved, 2);
  }
}

TEST_F(GlPatches, SwitchingTechniquesEqualsAFreshRender) {
  const Scene scene = test::loadAsset("table_room");
  FrameRenderer renderer(makeGlBackend());
  rendered(renderer, scene, SceneChanges::all(), settingsOf("naive", 60));
  for (const char* technique : {"light_maps", "visibility", "light_maps", "naive", "visibility"}) {
    const Settings settings = settingsOf(technique, 60);
    EXPECT_TRUE(test::sameBits(rendered(renderer, scene, {}, settings),
                               rendered(makeGlBackend(), scene, settings)))
        << technique;
  }
}

// If the memory is too small for light maps, pixels sum all lights, until there is enough memory
// again.
TEST_F(GlPatches, WithoutMemoryForLightMapsPixelsSumAllLights) {
  Scene scene = test::randomBoxes(80, 5);
  test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12, 9, 5));
  // Larger boxes: more tiles, but few enough roots for all of them to have entries.
  for (Node& node : scene.nodes) {
    node.local.translation *= 3.0f;
    node.local.scale *= 3.0f;
  }
  const View view = test::viewOf(scene, kWidth, kHeight);
  FrameRenderer kept(makeGlBackend());
  SceneChanges changes = SceneChanges::all();
  for (const int mebibytes : {512, 1, 512}) {
    Settings settings = settingsOf("light_maps", 60);
    settings.set("light_map_memory", mebibytes);
    const GiOutput out = test::renderSettled(kept, scene, changes, view, settings);
    EXPECT_EQ(out.stats.of("light_map_texel") > 0.0f, mebibytes > 1);
    EXPECT_TRUE(test::sameBits(out.radiance->pixels(), rendered(makeGlBackend(), scene, settings)))
        << mebibytes;
    changes = {};
  }
}

// A number of lights that needs several uniform blocks and several texture arrays of shadow maps;
// two kinds of light.
TEST_F(GlPatches, ThousandsOfLightsEqualTheCpuBackend) {
  Scene scene = test::loadAsset("pillar_room");
  scene.sky = vec3(0.3f, 0.4f, 0.5f);
  for (const char* technique : {"visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    Settings settings = settingsOf(technique, 2500);
    settings.set("map_resolution", 16);
    settings.set("updates", 5000);
    const Image gl = rendered(makeGlBackend(), scene, settings);
    const Metrics m = compareImages(gl, rendered(makeCpuBackend(), scene, settings));
    RecordProperty(technique, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.01);
    EXPECT_NEAR(m.bias, 1.0, 0.001);
  }
}

// A light map stores the front of a surface. Pixels that show its back, lit from behind, sum all
// lights.
TEST_F(GlPatches, BothSidesOfASurfaceAreLitCorrectly) {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(0.7f));
  scene.materials[static_cast<size_t>(material)].doubleSided = true;
  test::addMesh(scene, test::squareMesh(6.0f, material));
  test::addMesh(scene, test::boxMesh(vec3(0.5f), material), vec3(1.0f, 1.0f, 0.0f));
  test::addMesh(scene, test::boxMesh(vec3(0.5f), material), vec3(-1.0f, -1.0f, 0.0f));
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(9.0f, 6.0f, 3.0f));
  const NodeId below = test::addRectangleLight(scene, vec3(0, -3, 0), vec2(1.0f), vec3(2, 5, 8));
  scene.find(below)->local.rotation =
      glm::angleAxis(kPi, vec3(1, 0, 0)) * scene.find(below)->local.rotation;
  for (const float height : {2.5f, -2.5f}) {
    const View view = test::lookAt(vec3(3, height, 6), vec3(0), kWidth, kHeight);
    Image pictures[3];
    for (const int i : {0, 1, 2}) {
      FrameRenderer renderer(i < 2 ? makeGlBackend() : makeCpuBackend());
      pictures[i] = test::renderSettled(renderer, scene, SceneChanges::all(), view,
                                        settingsOf(i == 0 ? "naive" : "light_maps", 80))
                        .radiance->pixels();
    }
    ASSERT_GT(test::meanOf(pictures[1]).g, 0.01f);
    EXPECT_FALSE(test::sameBits(pictures[1], pictures[0]));
    EXPECT_LT(compareImages(pictures[1], pictures[0]).relRmse, 0.01) << height;
    EXPECT_LT(compareImages(pictures[1], pictures[2]).relRmse, 0.01) << height;
  }
}

}  // namespace
}  // namespace lamplighter
