// Smooth edges of pictures that have not settled.
#include <algorithm>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A lamp before a black sky, and a box that is lit by it.
struct LampAndBox {
  Scene scene;
  NodeId box = kNoNode;
  View view = test::lookAt(vec3(0.4f, -2.0f, 1.5f), vec3(0.4f, 0.0f, 0.0f), 96, 64);
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};

  LampAndBox() {
    const int grey = test::addMaterial(scene, vec3(0.5f));
    box = test::addMesh(scene, test::boxMesh(vec3(0.5f), grey), vec3(1.2f, -0.6f, 0.0f));
    test::addRectangleLight(scene, vec3(0.0f), vec2(1.0f), vec3(1.0f));
    settings.set("vpls", 200);
    settings.set("updates", 1);  // it takes long to settle
    settings.set("bounces", 0);
    settings.set("repair", 2);
  }
  Image frame(const SceneChanges& changes, bool isRepaired = true) {
    const GiOutput out = renderer.render({scene,
                                          changes,
                                          view,
                                          "many_lights",
                                          settings,
                                          false,
                                          {.refineUpdates = isRepaired ? 64 : 0}});
    EXPECT_FALSE(out.settled);
    return out.radiance->pixels();
  }
};

struct EarlyEdges : testing::Test, LampAndBox {};

// Largest difference in the part of the picture that shows the lamp.
float largestOff(const Image& a, const Image& b) {
  float most = 0.0f;
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width * 2 / 3; ++x)
      most = std::max(most, std::abs(a.at(x, y).r - b.at(x, y).r));
  return most;
}

TEST_F(EarlyEdges, ALampCoversTheShareOfAPixelThatRaysFind) {
  const Image covered = test::renderReference(scene, view, 256, 0);
  EXPECT_GT(largestOff(frame(SceneChanges::all(), false), covered), 0.4f);
  // Eight rays, against 256; in the first frame, too.
  EXPECT_LT(largestOff(frame(SceneChanges::all()), covered), 0.2f);
  EXPECT_LT(largestOff(frame({}), covered), 0.2f);
}

TEST_F(EarlyEdges, BitsDoNotDependOnThreads) {
  std::vector<Image> images;
  for (const size_t threads : {1u, 3u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    frame(SceneChanges::all());
    images.push_back(frame({}));
  }
  EXPECT_TRUE(test::sameBits(images[0], images[1]));
}

// A lamp that moves within its own plane: most pixels show the same points of it.
TEST_F(EarlyEdges, FollowALampInTheSameFrame) {
  frame(SceneChanges::all());
  frame({});
  const auto lamp =
      std::ranges::find_if(scene.nodes, [](const Node& n) { return n.area.has_value(); });
  ASSERT_NE(lamp, scene.nodes.end());
  float plain = 0.0f;
  for (int step = 0; step < 6; ++step) {
    const Scene before = scene;
    lamp->local.translation.x += 0.013f;
    const Image covered = test::renderReference(scene, view, 256, 0);
    EXPECT_LT(largestOff(frame(compare(before, scene)), covered), 0.2f) << step;
    FrameRenderer other(makeCpuBackend());
    plain = std::max(
        plain, largestOff(other.render({scene, SceneChanges::all(), view, "many_lights", settings})
                              .radiance->pixels(),
                          covered));
  }
  EXPECT_GT(plain, 0.4f);
}

TEST_F(EarlyEdges, FollowTheViewOneFrameLater) {
  const auto picturesOf = [&](bool isRepaired) {
    LampAndBox fresh;
    fresh.frame(SceneChanges::all(), isRepaired);
    fresh.frame({}, isRepaired);
    fresh.view = test::lookAt(vec3(0.5f, -2.0f, 1.5f), vec3(0.4f, 0.0f, 0.0f), 90, 64);
    std::vector<Image> pictures{fresh.frame({}, isRepaired)};
    pictures.push_back(fresh.frame({}, isRepaired));
    return pictures;
  };
  const std::vector<Image> plain = picturesOf(false), smooth = picturesOf(true);
  EXPECT_TRUE(test::sameBits(plain[0], smooth[0]));
  EXPECT_FALSE(test::sameBits(plain[1], smooth[1]));
}

TEST_F(EarlyEdges, AreNotSmoothedInReplays) {
  const Image first = frame(SceneChanges::all(), false);
  EXPECT_EQ(largestOff(frame({}, false), first), 0.0f);
}

// Compares each frame with that of a renderer that does not smooth, until the picture settles.
// Returns in how many frames this much was smooth already; their bits must be the same.
int comparedFrames(LampAndBox& level, SmoothEdges already) {
  level.settings.set("updates", 100);
  level.settings.set("bounces", 2);
  level.settings.set("indirect", std::string("meshes"));
  const auto picture = [&](FrameRenderer& by, int frame, int refineUpdates) {
    return by.render({level.scene,
                      frame == 0 ? SceneChanges::all() : SceneChanges(),
                      level.view,
                      "many_lights",
                      level.settings,
                      false,
                      {.refineUpdates = refineUpdates}});
  };
  FrameRenderer without(makeCpuBackend());
  int compared = 0;
  for (int frame = 0; frame < 1000; ++frame) {
    const GiOutput smoothed = picture(level.renderer, frame, 64);
    const GiOutput plain = picture(without, frame, 0);
    EXPECT_EQ(smoothed.smoothEdges, plain.smoothEdges);
    if (plain.settled) break;
    if (plain.smoothEdges != already) continue;
    EXPECT_TRUE(test::sameBits(smoothed.radiance->pixels(), plain.radiance->pixels())) << frame;
    ++compared;
  }
  return compared;
}

// While bounced light goes on, direct light and lamps have the edges of shifted pictures already.
TEST_F(EarlyEdges, AreNotSmoothedTwice) { EXPECT_GT(comparedFrames(*this, SmoothEdges::all), 0); }

// Without lamps only the sky has them: here all edges are those of a box against it.
TEST_F(EarlyEdges, AreNotSmoothedTwiceAgainstTheSky) {
  scene = Scene();
  const int grey = test::addMaterial(scene, vec3(0.5f));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), grey));
  scene.sky = vec3(1.0f);
  view = test::lookAt(vec3(0, 0, 4), vec3(0), 96, 64);
  EXPECT_GT(comparedFrames(*this, SmoothEdges::lights), 0);
}

}  // namespace
}  // namespace lamplighter
