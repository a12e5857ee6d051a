// Adaptive antialiasing: shifted samples of a pixel reuse the light of the middle sample where the
// picture is even. This saves most of the work with an error that is not visible, and the result
// does not depend on earlier frames.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Settings settingsOf(int antialias, const std::string& block) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("vpls", 200);
  s.set("updates", 200);
  s.set("bounces", 1);
  s.set("antialias", antialias);
  s.set("bias_compensation", false);
  s.set("block", block);
  return s;
}

struct Room : test::AssetRoom {
  explicit Room(const std::string& name) : AssetRoom(name, 320, 200) {}
};

Image settled(FrameRenderer& renderer, const Room& room, const SceneChanges& changes,
              const Settings& settings) {
  return test::renderSettled(renderer, room.scene, changes, room.view, settings).radiance->pixels();
}

class SharedSamples : public testing::TestWithParam<const char*> {};

TEST_P(SharedSamples, TakesLessWorkForTheSamePicture) {
  const Room room(GetParam());
  FrameRenderer renderer(makeCpuBackend());
  settled(renderer, room, SceneChanges::all(), settingsOf(1, "4"));
  const uint64_t once = test::lightCounts(renderer.backend()).lightPixels;
  const Image shared = settled(renderer, room, {}, settingsOf(8, "4"));
  const uint64_t eight = test::lightCounts(renderer.backend()).lightPixels - once;
  RecordProperty("share", std::to_string(static_cast<double>(eight) / (8.0 * once)));
  EXPECT_GT(eight, 0u);
  EXPECT_LT(eight, 6 * once);

  FrameRenderer other(makeCpuBackend());
  const Image each = settled(other, room, SceneChanges::all(), settingsOf(8, "1"));
  const double error = compareImages(shared, each).relRmse;
  RecordProperty("relRmse", std::to_string(error));
  // The error of low-resolution blocks alone, with one sample per pixel.
  const Image blocks = settled(renderer, room, {}, settingsOf(1, "4"));
  const Image all = settled(other, room, {}, settingsOf(1, "1"));
  EXPECT_LT(error, compareImages(blocks, all).relRmse + 0.002);
}
INSTANTIATE_TEST_SUITE_P(Rooms, SharedSamples,
                         testing::Values("pillar_room", "table_room", "cornell_style"));

TEST(SharedSamples, DoesNotDependOnEarlierFrames) {
  Room room("pillar_room");
  const Settings settings = settingsOf(4, "4");
  FrameRenderer renderer(makeCpuBackend());
  settled(renderer, room, SceneChanges::all(), settings);
  for (const char* name : {"mover", "ceiling light"}) {
    const Scene before = room.scene;
    for (Node& node : room.scene.nodes)
      if (node.name == name) node.local.translation.x += 0.2f;
    const Image kept = settled(renderer, room, compare(before, room.scene), settings);
    FrameRenderer fresh(makeCpuBackend());
    EXPECT_TRUE(test::sameBits(kept, settled(fresh, room, SceneChanges::all(), settings))) << name;
  }
  // Change the view, then restore it.
  const View view = room.view;
  room.view.eye.x += 0.1f;
  settled(renderer, room, {}, settings);
  room.view = view;
  FrameRenderer fresh(makeCpuBackend());
  EXPECT_TRUE(test::sameBits(settled(renderer, room, {}, settings),
                             settled(fresh, room, SceneChanges::all(), settings)));
}

// The border of a hard shadow on one plane is as smooth as without sharing, whether it lies between
// packets or within one.
TEST(SharedSamples, ShadowBordersStaySmooth) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(20.0f, test::addMaterial(scene, vec3(0.8f))));
  test::addMesh(scene, test::boxMesh(vec3(1.0f)), vec3(0, 2.0f, 0));
  const auto picture = [&](bool isShared) {
    test::LitScene lit(scene);
    shared::Vpl vpl = test::makeVpl(vec3(0.3f, 5.0f, 0.1f), vec3(0, -1, 0));
    vpl.intensity = vec3(50.0f);
    const std::vector vpls{vpl};
    lit.kernels->reserveShadowMaps(1, 512);
    lit.kernels->renderShadowMaps(vpls);
    const View view = test::lookAt(vec3(0, 1.5f, 6.0f), vec3(0, 0.5f, 0), 161, 99);
    shared::ShadingParams params{vec4(0.0f, 0.002f, 512.0f, 64.0f), vec4(4.0f, 0, 0, 0), vec4(0)};
    Image mean(view.width, view.height);
    if (isShared) {  // the middle sample, whose light the others reuse
      lit.backend->renderGBuffer(view, vec2(0.0f));
      lit.kernels->sumVpls(vpls, params, nullptr);
    }
    for (int i = 0; i < 16; ++i) {
      lit.backend->renderGBuffer(view, vec2((static_cast<float>(i % 4) - 1.5f) / 4.0f,
                                            (static_cast<float>(i / 4) - 1.5f) / 4.0f));
      lit.kernels->sumVpls(vpls, params, nullptr);
      const Image sample = lit.kernels->compose(false)->pixels();
      for (size_t p = 0; p < sample.pixels.size(); ++p) mean.pixels[p] += sample.pixels[p] / 16.0f;
    }
    return mean;
  };
  const double error = compareImages(picture(true), picture(false)).relRmse;
  RecordProperty("relRmse", std::to_string(error));
  EXPECT_LT(error, 0.002);
}

}  // namespace
}  // namespace lamplighter
