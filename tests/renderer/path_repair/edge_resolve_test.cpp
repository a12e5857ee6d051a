// Smooth edges of pictures that have not settled.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/support/lit_scene.h"
#include "tests/support/render.h"
#include "tests/support/scenes.h"

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
    const GiOutput out = renderer.render(
        {scene, changes, view, "many_lights", settings, false, false, isRepaired ? 64 : 0});
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
  const Image first = frame(SceneChanges::all());
  const Image second = frame({});
  EXPECT_GT(largestOff(first, covered), 0.4f);
  // Eight rays, against 256.
  EXPECT_LT(largestOff(second, covered), 0.2f);
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

// While an object moves the picture is shown as it is.
TEST_F(EarlyEdges, FollowObjectsAndTheViewOneFrameLater) {
  const auto picturesOf = [&](bool isRepaired) {
    LampAndBox fresh;
    fresh.frame(SceneChanges::all(), isRepaired);
    fresh.frame({}, isRepaired);
    const Scene before = fresh.scene;
    fresh.scene.find(fresh.box)->local.translation.x -= 0.2f;
    std::vector<Image> pictures{fresh.frame(compare(before, fresh.scene), isRepaired)};
    pictures.push_back(fresh.frame({}, isRepaired));
    fresh.view = test::lookAt(vec3(0.5f, -2.0f, 1.5f), vec3(0.4f, 0.0f, 0.0f), 90, 64);
    pictures.push_back(fresh.frame({}, isRepaired));
    pictures.push_back(fresh.frame({}, isRepaired));
    return pictures;
  };
  const std::vector<Image> plain = picturesOf(false), smooth = picturesOf(true);
  for (const size_t edit : {0u, 2u}) {
    EXPECT_TRUE(test::sameBits(plain[edit], smooth[edit])) << edit;
    EXPECT_FALSE(test::sameBits(plain[edit + 1], smooth[edit + 1])) << edit;
  }
}

TEST_F(EarlyEdges, AreNotSmoothedInReplays) {
  const Image first = frame(SceneChanges::all(), false);
  EXPECT_EQ(largestOff(frame({}, false), first), 0.0f);
}

}  // namespace
}  // namespace lamplighter
