// A picture at rest that is refined, on the cpu backend.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/metrics.h"
#include "tests/support/lit_scene.h"
#include "tests/support/render.h"
#include "tests/support/scenes.h"

namespace lamplighter {
namespace {

using test::sameBits;

constexpr int kBounces = 2;

// A closed room with a box in it, so small that a quarter of it is nearer to a wall than the clamp.
struct Refined : testing::Test {
  Scene scene;
  NodeId box = kNoNode;
  View view = test::lookAt(vec3(1.2f, 1.6f, 1.3f), vec3(-0.4f, 0.7f, -0.5f), 64, 48, 1.1f);
  Settings settings;
  std::unique_ptr<FrameRenderer> renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  int updates = 64;

  Refined() {
    const int white = test::addMaterial(scene, vec3(0.7f, 0.6f, 0.5f));
    test::addMesh(scene, test::roomMesh(vec3(3, 2.4f, 3), white), vec3(0, 1.2f, 0));
    box = test::addMesh(scene, test::boxMesh(vec3(0.7f), white), vec3(-0.5f, 0.35f, -0.5f));
    test::addRectangleLight(scene, vec3(0.2f, 2.2f, 0.1f), vec2(0.8f, 0.6f), vec3(10, 8, 6));
    settings.set("vpls", 200);
    settings.set("bounces", kBounces);
    settings.set("updates", 70);
    settings.set("antialias", 4);
    settings.set("map_resolution", 32);
    settings.set("refine", 4096);
  }

  GiOutput step(const SceneChanges& changes = {}, bool refines = true) {
    return renderer->render(
        {scene, changes, view, "many_lights", settings, false, false, refines ? updates : 0});
  }
  // The picture once it is settled and, where it is asked for, refined.
  GiOutput rest(const SceneChanges& changes, bool refines) {
    GiOutput out = step(changes, refines);
    for (int i = 0; i < 2000 && !(out.settled && (out.refined || !refines)); ++i)
      out = step({}, refines);
    EXPECT_TRUE(out.settled);
    EXPECT_EQ(out.refined, true);
    return out;
  }
  // The same scene and settings from nothing, never refined.
  Image liveFromNothing() {
    FrameRenderer fresh(makeCpuBackend());
    return test::renderSettled(fresh, scene, SceneChanges::all(), view, settings)
        .radiance->pixels();
  }
};

TEST_F(Refined, ConvergesToThePathTracer) {
  const Image reference = test::renderReference(scene, view, 2048, kBounces);
  settings.set("map_resolution", 64);
  double last = 1.0;
  for (const int vpls : {1024, 4096, 16384}) {
    settings.set("refine", vpls);
    const GiOutput out = rest(vpls == 1024 ? SceneChanges::all() : SceneChanges(), true);
    EXPECT_GE(out.stats.of("vpls_refined"), vpls);
    const Metrics m = compareImages(out.radiance->pixels(), reference);
    RecordProperty("relRmse" + std::to_string(vpls), std::to_string(m.relRmse));
    RecordProperty("bias" + std::to_string(vpls), std::to_string(m.bias));
    EXPECT_LT(m.relRmse, 0.7 * last) << vpls;
    last = m.relRmse;
    if (vpls < 16384) continue;
    EXPECT_LT(m.relRmse, 0.02);
    EXPECT_NEAR(m.bias, 1.0, 0.005);
  }
}

TEST_F(Refined, TheSameBitsAtAnyNumberOfThreads) {
  std::vector<Image> images;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    images.push_back(rest(SceneChanges::all(), true).radiance->pixels());
  }
  EXPECT_TRUE(sameBits(images[0], images[1]));
  EXPECT_TRUE(sameBits(images[0], images[2]));
}

// At the next edit the live picture is there again, and settles to what it would be without.
TEST_F(Refined, AnEditDropsBackAndLeavesNoTrace) {
  const Image before = rest(SceneChanges::all(), true).radiance->pixels();
  for (int frames : {0, 3, 40}) {  // on the way to the next refined picture
    const Scene old = scene;
    scene.find(box)->local.translation.x += 0.1f;
    GiOutput out = step(compare(old, scene));
    EXPECT_EQ(out.stats.of("vpls_refined"), 0);
    EXPECT_FALSE(out.settled);
    EXPECT_FALSE(out.refined);
    while (!out.settled) out = step();
    for (int i = 0; i < frames; ++i) out = step();
  }
  // Settled but not refined: the frame in which the last sample of the edges came.
  const Scene old = scene;
  scene.find(box)->local.translation.z += 0.1f;
  GiOutput out = step(compare(old, scene));
  while (!out.settled) out = step();
  EXPECT_TRUE(sameBits(out.radiance->pixels(), liveFromNothing()));
}

// Settings and views too; the picture of each is that of a fresh start.
TEST_F(Refined, WhatIsShownOtherwiseIsRefinedAnew) {
  rest(SceneChanges::all(), true);
  const auto isAsFromNothing = [&](const char* what) {
    const Image picture = rest({}, true).radiance->pixels();
    auto used = std::move(renderer);
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    EXPECT_TRUE(sameBits(picture, rest(SceneChanges::all(), true).radiance->pixels())) << what;
    renderer = std::move(used);
  };
  settings.set("refine", 2048);
  isAsFromNothing("refine");
  settings.set("clamp_distance", 0.2f);
  isAsFromNothing("clamp_distance");
  settings.set("seed", 5);
  isAsFromNothing("seed");
  settings.set("antialias", 1);
  isAsFromNothing("antialias");
  settings.set("map_resolution", 16);
  isAsFromNothing("map_resolution");
  settings.set("technique", std::string("naive"));
  isAsFromNothing("technique");
  view.eye.x -= 0.2f;
  isAsFromNothing("view");
  view.width = 50;
  isAsFromNothing("size");
  settings.set("bounces", 0);
  isAsFromNothing("bounces");
}

// Batch by batch the picture becomes another, none of them far from the one before.
TEST_F(Refined, NeverFlashes) {
  GiOutput out = rest(SceneChanges::all(), false);
  // Maps are reserved anew.
  out = step();
  while (!out.settled) out = step();
  const float live = test::meanOf(out.radiance->pixels()).g;
  float last = live;
  int pictures = 0;
  while (!out.refined) {
    const auto before = out.radiance;
    out = step();
    if (out.radiance == before) continue;
    ++pictures;
    const float mean = test::meanOf(out.radiance->pixels()).g;
    EXPECT_NEAR(mean / last, 1.0f, 0.02f) << pictures;
    last = mean;
  }
  EXPECT_GT(pictures, 4);
  RecordProperty("refinedOverLive", std::to_string(last / live));
}

TEST_F(Refined, KeepsTheBudget) {
  updates = 10;
  GiOutput out = step(SceneChanges::all());
  while (!out.settled) out = step();
  while (!out.refined) {
    const uint64_t maps = test::lightCounts(renderer->backend()).shadowMaps;
    out = step();
    EXPECT_LE(test::lightCounts(renderer->backend()).shadowMaps - maps, 10u);
    EXPECT_EQ(test::lightCounts(renderer->backend()).shadowMaps - maps,
              static_cast<uint64_t>(out.stats.refineUpdates));
  }
  // And then nothing more is done.
  const auto picture = out.radiance;
  const uint64_t sums = test::lightCounts(renderer->backend()).lightPixels;
  out = step();
  EXPECT_TRUE(out.refined);
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(test::lightCounts(renderer->backend()).lightPixels, sums);
}

// Who does not ask for it has it not, whatever the setting says.
TEST_F(Refined, IsOffUnlessTheCallerLetsIt) {
  GiOutput out = rest(SceneChanges::all(), false);
  const auto picture = out.radiance;
  const uint64_t maps = test::lightCounts(renderer->backend()).shadowMaps;
  out = step({}, false);
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(test::lightCounts(renderer->backend()).shadowMaps, maps);
  EXPECT_EQ(out.stats.of("vpls_to_refine"), 0);
}

TEST_F(Refined, ScenesWithoutLightAreRefinedAtOnce) {
  Scene dark;
  test::addMesh(dark, test::squareMesh(2.0f));
  for (const Scene& s : {dark, Scene()}) {
    scene = s;
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    EXPECT_EQ(test::meanOf(rest(SceneChanges::all(), true).radiance->pixels()), scene.sky.radiance);
  }
}

}  // namespace
}  // namespace lamplighter
