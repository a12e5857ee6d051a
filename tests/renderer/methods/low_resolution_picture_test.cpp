// The low-resolution pass on the cpu backend: close to the full-resolution picture, without light
// leaks at edges.
#include <filesystem>
#include <ostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 240;

Settings settingsOf(int vpls, const std::string& block) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("updates", vpls);
  s.set("bounces", 1);
  s.set("antialias", 1);
  s.set("block", block);
  return s;
}

std::vector<View> viewsOf(const Scene& scene, int scale = 1) {
  std::vector<View> views;
  for (const Node& node : scene.nodes)
    if (node.camera != kNone)
      views.push_back(viewOfCamera(scene, node, scale * kWidth, scale * kHeight));
  if (views.empty()) {
    const RenderScene render = test::renderSceneOf(scene);
    views.push_back(viewOfBounds(render.bounds, scale * kWidth, scale * kHeight));
  }
  return views;
}

struct Case {
  const char* scene;
  int vpls;
  float leastInterpolated;
  double mostError = 0.015;
  int mapResolution = 64;
  int scale = 1;  // of the picture: small surfaces have no entries, so that sunlight is not
                  // interpolated on them
};
void PrintTo(const Case& c, std::ostream* out) { *out << c.scene; }

class LowResolutionPicture : public testing::TestWithParam<Case> {};

TEST_P(LowResolutionPicture, IsCloseToFullResolution) {
  const fs::path path = test::sceneFile(GetParam().scene);
  if (!fs::exists(path)) GTEST_SKIP() << "no " << path;
  const Scene scene = loadGltf(path).scene;
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  for (const View& view : viewsOf(scene, GetParam().scale)) {
    const auto picture = [&](const std::string& block) {
      Settings settings = settingsOf(GetParam().vpls, block);
      settings.set("map_resolution", GetParam().mapResolution);
      GiOutput out = test::renderSettled(renderer, scene, changes, view, settings);
      changes = {};
      return out;
    };
    const GiOutput all = picture("1"), blocks = picture("4");
    const Metrics m = compareImages(blocks.radiance->pixels(), all.radiance->pixels());
    const double share = blocks.stats.of("interpolated_share");
    RecordProperty("relRmse", std::to_string(m.relRmse));
    RecordProperty("interpolated", std::to_string(share));
    EXPECT_EQ(all.stats.of("interpolated_share"), 0.0f);
    EXPECT_LT(m.relRmse, GetParam().mostError);
    EXPECT_NEAR(m.bias, 1.0, 0.002);
    EXPECT_GT(share, GetParam().leastInterpolated);
  }
}
INSTANTIATE_TEST_SUITE_P(
    Scenes, LowResolutionPicture,
    testing::Values(Case{"default.gltf", 300, 0.3f}, Case{"area_light_room.gltf", 300, 0.3f},
                    Case{"pillar_room.gltf", 300, 0.3f}, Case{"table_room.gltf", 300, 0.3f},
                    Case{"cornell_style.gltf", 300, 0.3f},
                    Case{"narrow_gap.gltf", 300, 0.1f, 0.03, 256},
                    Case{"cornell-box/cornell-box.glb", 300, 0.1f},
                    Case{"kenney-fps-level/kenney-fps-level.gltf", 100, 0.02f, 0.015, 64, 3},
                    Case{"classroom/classroom.gltf", 300, 0.05f},
                    Case{"modern-hall/modern-hall.glb", 100, 0.3f, 0.03}));

// A floor with a wall that is thinner than a pixel, lit from one side only.
struct Wall {
  Scene scene;
  View view = test::lookAt(vec3(0, 6, 0.01f), vec3(0), 128, 96);
  Wall() {
    const int white = test::addMaterial(scene, vec3(0.8f));
    test::addMesh(scene, test::squareMesh(8.0f, white));
    test::addMesh(scene, test::boxMesh(vec3(0.01f, 2.0f, 9.0f), white), vec3(0.013f, 1, 0));
  }
  Image picture(float block) const {
    test::LitScene lit(scene);
    shared::Vpl vpl = test::makeVpl(vec3(-1.5f, 1.9f, 0), vec3(0.2f, -1, 0));
    vpl.intensity = vec3(5.0f);
    lit.kernels->reserveShadowMaps(1, 256);
    lit.kernels->renderShadowMaps({&vpl, 1});
    lit.backend->renderGBuffer(view, vec2(0.0f));
    lit.kernels->sumVpls({&vpl, 1}, {vec4(0.1f, 0.002f, 256.0f, 64.0f), vec4(block, 0, 0, 0)},
                         nullptr);
    return lit.kernels->compose()->pixels();
  }
};

TEST(LowResolution, LeaksNoLightPastAThinWall) {
  const Wall wall;
  const Image all = wall.picture(1.0f);
  int dark = 0, lit = 0;
  for (const float block : {2.0f, 4.0f, 8.0f}) {
    const Image image = wall.picture(block);
    for (size_t i = 0; i < all.pixels.size(); ++i) {
      if (all.pixels[i] != vec3(0.0f)) {
        ++lit;
        continue;
      }
      ++dark;
      EXPECT_EQ(image.pixels[i], vec3(0.0f)) << i % 128 << ", " << i / 128;
    }
  }
  EXPECT_GT(dark, 10000);
  EXPECT_GT(lit, 10000);
}

// A uniformly lit floor consists of interpolated cells only, for any size of picture, tiles and
// blocks.
TEST(LowResolution, ReachesTheLastRowAndColumn) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(80.0f, test::addMaterial(scene, vec3(0.8f))));
  test::LitScene lit(scene);
  shared::Vpl vpl = test::makeVpl(vec3(0, 50, 0), vec3(0, -1, 0));
  vpl.intensity = vec3(5.0f);
  lit.kernels->reserveShadowMaps(1, 64);
  lit.kernels->renderShadowMaps({&vpl, 1});
  for (const glm::ivec2 size : {glm::ivec2(64, 64), glm::ivec2(128, 32), glm::ivec2(96, 256),
                                glm::ivec2(61, 35), glm::ivec2(65, 129)}) {
    for (const float block : {2.0f, 4.0f, 8.0f}) {
      for (const float moving : {0.0f, 1.0f}) {
        SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + " by " +
                     std::to_string(block) + (moving != 0.0f ? " while moving" : ""));
        const uint64_t before = lit.kernels->lightCounts().pixelsInterpolated;
        lit.backend->renderGBuffer(test::lookAt(vec3(0, 6, 0.01f), vec3(0), size.x, size.y),
                                   vec2(0.0f));
        lit.kernels->sumVpls(
            {&vpl, 1}, {vec4(0.1f, 0.002f, 64.0f, 64.0f), vec4(block, moving, 0, 0)}, nullptr);
        EXPECT_EQ(lit.kernels->lightCounts().pixelsInterpolated - before,
                  static_cast<uint64_t>(size.x * size.y));
      }
    }
  }
}

// While the camera moves, samples are interpolated as well. When it stops, the settled picture
// equals a fresh render.
class MovingCamera : public testing::TestWithParam<Case> {};

TEST_P(MovingCamera, IsCloseToTheSettledPicture) {
  const Scene scene = loadGltf(test::sceneFile(GetParam().scene)).scene;
  Settings settings = settingsOf(GetParam().vpls, "4");
  settings.set("importance", 1);  // importance does not choose other light samples
  settings.set("settled_map_scale", 1);
  settings.set("bias_compensation", false);
  const View view = viewsOf(scene)[0];
  View moved = view;
  moved.eye += vec3(0.02f, 0.01f, 0.0f);
  FrameRenderer renderer(makeCpuBackend()), other(makeCpuBackend());
  test::renderSettled(renderer, scene, SceneChanges::all(), view, settings);
  const auto sums = [&] { return test::lightCounts(renderer.backend()).lightPixels; };
  const uint64_t before = sums();
  GiOutput out = renderer.render({scene, {}, moved, "many_lights", settings});
  const uint64_t whileMoving = sums() - before;
  EXPECT_FALSE(out.settled);
  const Image moving = out.radiance->pixels();
  out = test::renderSettled(renderer, scene, {}, moved, settings);
  const Image settled = out.radiance->pixels();
  const GiOutput fresh = test::renderSettled(other, scene, SceneChanges::all(), moved, settings);
  EXPECT_TRUE(test::sameBits(settled, fresh.radiance->pixels()));
  const Metrics m = compareImages(moving, settled);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, GetParam().mostError);
  EXPECT_GT(m.relRmse, 0.0);
  EXPECT_NEAR(m.bias, 1.0, 0.001);
  // At this size it saves little work compared with all samples, and costs slightly more where most
  // of the picture is narrow stripes of light (narrow_gap).
  const uint64_t whole = test::lightCounts(other.backend()).lightPixels;
  RecordProperty("sums", std::to_string(whileMoving) + " of " + std::to_string(whole));
  EXPECT_LT(static_cast<double>(whileMoving), 1.03 * static_cast<double>(whole));
}
INSTANTIATE_TEST_SUITE_P(Scenes, MovingCamera,
                         testing::Values(Case{"area_light_room.gltf", 200, 0.0f, 0.01},
                                         Case{"table_room.gltf", 200, 0.0f, 0.01},
                                         Case{"narrow_gap.gltf", 200, 0.0f, 0.01}));

// Cells at the sky and on curved surfaces are not interpolated.
TEST(LowResolution, SpheresInFrontOfTheSkyAreNotInterpolated) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(0.5f, 16, 0.0f, test::addMaterial(scene, vec3(0.8f))));
  test::LitScene lit(scene);
  const View view = test::lookAt(vec3(0, 0, 3), vec3(0), 64, 64, 0.6f);
  shared::Vpl vpl = test::makeVpl(vec3(0, 2, 4), vec3(0, -0.5f, -1));
  vpl.intensity = vec3(5.0f);
  const auto picture = [&](float block) {
    lit.kernels->reserveShadowMaps(1, 64);
    lit.kernels->renderShadowMaps({&vpl, 1});
    lit.backend->renderGBuffer(view, vec2(0.0f));
    lit.kernels->sumVpls({&vpl, 1}, {vec4(0.1f, 0.002f, 64.0f, 64.0f), vec4(block, 0, 0, 0)},
                         nullptr);
    return lit.kernels->compose()->pixels();
  };
  EXPECT_TRUE(test::sameBits(picture(1.0f), picture(4.0f)));
  EXPECT_EQ(lit.kernels->lightCounts().pixelsInterpolated, 0u);
}

}  // namespace
}  // namespace lamplighter
