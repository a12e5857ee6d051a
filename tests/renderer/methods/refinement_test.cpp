// Refinement of a settled picture on the cpu backend.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/metrics.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

using test::sameBits;

constexpr int kBounces = 2;

struct Refined : testing::Test, test::SmallRoom {
  Settings settings;
  std::unique_ptr<FrameRenderer> renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  int updates = 64;

  Refined() {
    settings.set("vpls", 200);
    settings.set("bounces", kBounces);
    settings.set("indirect", std::string("samples"));
    settings.set("updates", 70);
    settings.set("antialias", 4);
    settings.set("map_resolution", 32);
    settings.set("refine", 4096);
    settings.set("repair", 0);
  }

  GiOutput step(const SceneChanges& changes = {}, bool refines = true) {
    return renderer->render({scene,
                             changes,
                             view,
                             "many_lights",
                             settings,
                             false,
                             {.refineUpdates = refines ? updates : 0}});
  }
  // Renders until the picture is settled and, if `refines`, refined.
  GiOutput rest(const SceneChanges& changes, bool refines) {
    GiOutput out = step(changes, refines);
    for (int i = 0; i < 2000 && !(out.settled && (out.refined || !refines)); ++i)
      out = step({}, refines);
    EXPECT_TRUE(out.settled);
    EXPECT_EQ(out.refined, true);
    return out;
  }
  // The settled picture of a new renderer, without refinement.
  Image freshLivePicture() { return test::freshPicture(makeCpuBackend(), scene, view, settings); }
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

TEST_F(Refined, HasTheSameBitsAtAnyNumberOfThreads) {
  std::vector<Image> images;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    images.push_back(rest(SceneChanges::all(), true).radiance->pixels());
  }
  EXPECT_TRUE(sameBits(images[0], images[1]));
  EXPECT_TRUE(sameBits(images[0], images[2]));
}

// After an edit the live picture is shown again. It settles to the picture that it has without
// refinement.
TEST_F(Refined, AnEditReturnsToTheLivePicture) {
  const Image before = rest(SceneChanges::all(), true).radiance->pixels();
  for (int frames : {0, 3, 40}) {  // while the next refined picture is computed
    const Scene old = scene;
    scene.find(box)->local.translation.x += 0.1f;
    GiOutput out = step(compare(old, scene));
    EXPECT_EQ(out.stats.of("vpls_refined"), 0);
    EXPECT_FALSE(out.settled);
    EXPECT_FALSE(out.refined);
    while (!out.settled) out = step();
    for (int i = 0; i < frames; ++i) out = step();
  }
  // Stops at the frame with the last antialiasing sample: settled but not refined.
  const Scene old = scene;
  scene.find(box)->local.translation.z += 0.1f;
  GiOutput out = step(compare(old, scene));
  while (!out.settled) out = step();
  EXPECT_TRUE(sameBits(out.radiance->pixels(), freshLivePicture()));
}

// Changed settings and views restart the refinement. The result equals that of a new renderer.
TEST_F(Refined, ChangedSettingsAndViewsRestartTheRefinement) {
  rest(SceneChanges::all(), true);
  const auto expectEqualsFresh = [&](const char* what) {
    const Image picture = rest({}, true).radiance->pixels();
    auto used = std::move(renderer);
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    EXPECT_TRUE(sameBits(picture, rest(SceneChanges::all(), true).radiance->pixels())) << what;
    renderer = std::move(used);
  };
  settings.set("refine", 2048);
  expectEqualsFresh("refine");
  settings.set("clamp_distance", 0.2f);
  expectEqualsFresh("clamp_distance");
  settings.set("seed", 5);
  expectEqualsFresh("seed");
  settings.set("antialias", 1);
  expectEqualsFresh("antialias");
  settings.set("map_resolution", 16);
  expectEqualsFresh("map_resolution");
  settings.set("technique", std::string("naive"));
  expectEqualsFresh("technique");
  view.eye.x -= 0.2f;
  expectEqualsFresh("view");
  view.width = 50;
  expectEqualsFresh("size");
  settings.set("bounces", 0);
  expectEqualsFresh("bounces");
}

// Each batch changes the picture only slightly.
TEST_F(Refined, NeverFlashes) {
  GiOutput out = rest(SceneChanges::all(), false);
  // This step reserves the shadow maps again.
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
  // Afterwards no more work is done.
  const auto picture = out.radiance;
  const uint64_t sums = test::lightCounts(renderer->backend()).lightPixels;
  out = step();
  EXPECT_TRUE(out.refined);
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(test::lightCounts(renderer->backend()).lightPixels, sums);
}

// Without permission of the caller nothing is refined, for any value of the setting.
TEST_F(Refined, IsOffUnlessTheCallerAllowsIt) {
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
