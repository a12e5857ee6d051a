// Settled pictures, repaired by paths.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

using test::sameBits;

constexpr int kBounces = 2;

struct Repaired : testing::Test, test::SmallRoom {
  Settings settings;
  std::string method = "many_lights";
  std::unique_ptr<FrameRenderer> renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  int rows = 64;        // of paths, in a frame
  int previewRows = 0;  // before the picture has settled
  int previewFrames = 0;

  Repaired() {
    settings.set("vpls", 60);
    settings.set("bounces", kBounces);
    settings.set("indirect", std::string("samples"));
    settings.set("updates", 4096);
    settings.set("antialias", 4);
    settings.set("repair", 64);
  }

  GiOutput step(const SceneChanges& changes = {}, bool repairs = true) {
    return renderer->render({scene,
                             changes,
                             view,
                             method,
                             settings,
                             false,
                             {.refineUpdates = repairs ? rows : 0,
                              .previewUpdates = previewRows,
                              .previewFrames = previewFrames}});
  }
  GiOutput rest(const SceneChanges& changes, bool repairs = true) {
    GiOutput out = step(changes, repairs);
    for (int i = 0; i < 4000 && !(out.settled && (out.refined || !repairs)); ++i)
      out = step({}, repairs);
    EXPECT_TRUE(out.settled);
    EXPECT_TRUE(out.refined);
    return out;
  }
  Image fresh() {
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    return rest(SceneChanges::all()).radiance->pixels();
  }
  SceneChanges edit(const std::function<void(Scene&)>& change) {
    const Scene old = scene;
    change(scene);
    return compare(old, scene);
  }
};

TEST_F(Repaired, ConvergesToThePathTracer) {
  const Image reference = test::renderReference(scene, view, 4096, kBounces);
  const auto errorOf = [&](const Image& picture) { return compareImages(picture, reference); };
  double last = errorOf(rest(SceneChanges::all(), false).radiance->pixels()).relRmse;
  RecordProperty("live", std::to_string(last));
  for (const int paths : {16, 128, 1024}) {
    settings.set("repair", paths);
    const GiOutput out = rest({});
    EXPECT_EQ(out.stats.of("paths_repaired"), paths);
    const Metrics m = errorOf(out.radiance->pixels());
    RecordProperty("relRmse" + std::to_string(paths), std::to_string(m.relRmse));
    RecordProperty("bias" + std::to_string(paths), std::to_string(m.bias));
    EXPECT_LT(m.relRmse, 0.8 * last) << paths;
    last = m.relRmse;
    EXPECT_NEAR(m.bias, 1.0, 0.02);
  }
  EXPECT_LT(last, 0.02);
}

TEST_F(Repaired, BitsDoNotDependOnThreadsAndFrames) {
  for (const char* carrier : {"samples", "meshes", "links"}) {
    settings.set("indirect", std::string(carrier));
    std::vector<Image> images;
    for (const size_t threads : {1u, 2u, 5u}) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      rows = threads == 2 ? 7 : 1000;
      images.push_back(fresh());
    }
    EXPECT_TRUE(sameBits(images[0], images[1])) << carrier;
    EXPECT_TRUE(sameBits(images[0], images[2])) << carrier;
  }
}

// Paths end at light on surfaces, so each needs fewer rays, and what that light lacks is found.
TEST_F(Repaired, PathsEndAtKnownLight) {
  const auto raysOf = [&](const char* carrier) {
    settings.set("indirect", std::string(carrier));
    rows = 1 << 20;
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    double rays = 0.0;
    GiOutput out = step(SceneChanges::all());
    for (int i = 0; i < 4000 && !(out.settled && out.refined); ++i) {
      out = step();
      if (out.settled) rays += out.stats.of("repair_rays");
    }
    return rays;
  };
  settings.set("bounces", 5);
  settings.set("repair", 256);  // the first paths do not end
  const double all = raysOf("samples"), ended = raysOf("meshes");
  RecordProperty("share", std::to_string(ended / all));
  EXPECT_LT(ended, 0.7 * all);
}

TEST_F(Repaired, EditsLeaveFreshBits) {
  rest(SceneChanges::all());
  const auto expectFresh = [&](const SceneChanges& changes, const char* what) {
    const Image picture = rest(changes).radiance->pixels();
    auto used = std::move(renderer);
    EXPECT_TRUE(sameBits(picture, fresh())) << what;
    renderer = std::move(used);
  };
  expectFresh(edit([&](Scene& s) { s.find(box)->local.translation.x += 0.2f; }), "place");
  settings.set("indirect", std::string("meshes"));
  expectFresh({}, "known light");
  expectFresh(edit([&](Scene& s) { s.find(box)->local.translation.x -= 0.15f; }), "its place");
  expectFresh(edit([&](Scene& s) { s.find(lamp)->area->radiance *= 0.5f; }), "brightness");
  expectFresh(edit([&](Scene& s) { s.materials[0].baseColor.r = 0.2f; }), "colour");
  view.eye.x -= 0.2f;
  expectFresh({}, "view");
  settings.set("bounces", 1);
  expectFresh({}, "bounces");
  settings.set("speculars", false);
  expectFresh({}, "speculars");
  settings.set("seed", 3);
  expectFresh({}, "seed");
  settings.set("repair", 32);
  renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  rest(SceneChanges::all());
  settings.set("repair", 64);  // goes on
  expectFresh({}, "more paths");
  settings.set("repair", 16);
  expectFresh({}, "fewer paths");
}

// Large pictures are repaired before each pixel has a path. The same paths repair the settled
// picture, also if it settles while blocks are traced.
TEST_F(Repaired, PreviewsLargePicturesInBlocks) {
  view.width = 480;
  view.height = 321;  // not a multiple of the side of a block
  settings.set("repair", 2);
  settings.set("updates", 2);  // so that it settles slowly
  previewRows = 48;
  previewFrames = 3;
  Image live = step(SceneChanges::all()).radiance->pixels();
  GiOutput out;
  bool isRepaired = false;
  for (int frame = 0; frame < 100 && !isRepaired; ++frame) {
    out = step();
    ASSERT_FALSE(out.settled) << frame;
    EXPECT_LE(out.stats.previewUpdates, previewRows);
    // Frames that only trace paths show the last picture of the method until it is repaired.
    if (out.stats.updates == 0 && out.stats.previewUpdates > 0)
      isRepaired = !sameBits(out.radiance->pixels(), live);
    else
      live = out.radiance->pixels();
  }
  EXPECT_TRUE(isRepaired);
  EXPECT_EQ(out.stats.of("paths_repaired"), 0);
  settings.set("updates", 4096);
  previewRows = 1;
  for (int frame = 0; frame < 400 && !out.settled; ++frame) out = step();
  ASSERT_TRUE(out.settled);
  EXPECT_EQ(out.stats.of("paths_repaired"), 0);  // it settled while blocks were traced
  const Image picture = rest({}).radiance->pixels();
  previewRows = 0;
  EXPECT_TRUE(sameBits(picture, fresh()));
}

// Before a picture has settled it is repaired, too, and that leaves no trace.
TEST_F(Repaired, PreviewsThePictureBeforeItSettles) {
  const Image reference = averageBlocks(test::renderReference(scene, view, 1024, kBounces), 4);
  settings.set("updates", 2);  // so that it settles slowly
  for (const char* carrier : {"samples", "meshes"}) {
    settings.set("indirect", std::string(carrier));
    previewRows = 0;
    const Image settled = fresh();
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    GiOutput out = step(SceneChanges::all());
    for (int frame = 0; frame < 4; ++frame) out = step();
    ASSERT_FALSE(out.settled) << carrier;
    const auto errorOf = [&](const GiOutput& shown) {
      return compareImages(averageBlocks(shown.radiance->pixels(), 4), reference).relRmse;
    };
    const double live = errorOf(out);
    previewRows = 48;
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    step(SceneChanges::all());
    for (int frame = 0; frame < 4; ++frame) out = step();
    ASSERT_FALSE(out.settled) << carrier;
    EXPECT_GT(out.stats.previewUpdates, 0) << carrier;
    RecordProperty(std::string(carrier) + "Live", std::to_string(live));
    RecordProperty(std::string(carrier) + "Preview", std::to_string(errorOf(out)));
    // Meshes are right to 1% by then; the noise of four paths shows as less than another 1%.
    EXPECT_LT(errorOf(out), std::max(0.7 * live, 0.02)) << carrier;
    EXPECT_TRUE(sameBits(rest({}).radiance->pixels(), settled)) << carrier;
    const GiOutput edited = step(edit([&](Scene& s) { s.find(box)->local.translation.z += 0.1f; }));
    EXPECT_EQ(edited.stats.of("paths_repaired"), 0.0) << carrier;
    scene.find(box)->local.translation.z -= 0.1f;
  }
}

// Frames that only trace paths: the method works in one of four, until there are enough of them.
TEST_F(Repaired, FramesOfPathsAloneLeaveFreshBits) {
  settings.set("updates", 2);
  const Image settled = fresh();
  renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
  previewRows = 24;
  previewFrames = 3;
  step(SceneChanges::all());
  for (int frame = 0; frame < 12; ++frame) {
    const bool isOfMethod = frame % 4 == 0;  // as the first
    const GiOutput out = step();
    ASSERT_FALSE(out.settled);
    EXPECT_EQ(out.stats.updates > 0, isOfMethod) << frame;
    EXPECT_EQ(out.stats.previewUpdates > 0, !isOfMethod) << frame;
  }
  // So is the edit, and the first frame after it.
  const auto moveBox = [&](float by) {
    return edit([&](Scene& s) { s.find(box)->local.translation.z += by; });
  };
  EXPECT_GT(step(moveBox(0.1f)).stats.updates, 0);
  EXPECT_GT(step().stats.updates, 0);
  EXPECT_EQ(step().stats.updates, 0);
  settings.set("updates", 3);  // a budget
  EXPECT_EQ(step().stats.updates, 0);
  settings.set("bounces", kBounces - 1);
  EXPECT_GT(step().stats.updates, 0);
  settings.set("bounces", kBounces);
  EXPECT_TRUE(sameBits(rest(moveBox(-0.1f)).radiance->pixels(), settled));
}

// Nor while the camera moves.
TEST_F(Repaired, AFlightTracesNoPaths) {
  settings.set("updates", 2);
  previewRows = 48;
  step(SceneChanges::all());
  for (int frame = 0; frame < 4; ++frame) {
    view.eye.x -= 0.01f;
    const GiOutput out = step();
    ASSERT_FALSE(out.settled);
    EXPECT_EQ(out.stats.previewUpdates, 0) << frame;
  }
  EXPECT_GT(step().stats.previewUpdates, 0);
}

// Paths that do not end at known light are kept only as far as a fresh start has them, too.
TEST_F(Repaired, AnotherCarrierLeavesFreshBits) {
  previewRows = 7;
  rest(SceneChanges::all());
  for (const char* carrier : {"meshes", "samples"}) {
    settings.set("indirect", std::string(carrier));
    const Image picture = rest({}).radiance->pixels();
    auto used = std::move(renderer);
    EXPECT_TRUE(sameBits(picture, fresh())) << carrier;
    renderer = std::move(used);
  }
}

TEST_F(Repaired, AnEditReturnsToTheLivePicture) {
  rest(SceneChanges::all());
  GiOutput out = step(edit([&](Scene& s) { s.find(box)->local.translation.z += 0.1f; }));
  EXPECT_EQ(out.stats.of("paths_repaired"), 0);
  out = rest({}, false);
  EXPECT_TRUE(sameBits(out.radiance->pixels(),
                       test::freshPicture(makeCpuBackend(), scene, view, settings)));
}

// A change of brightness settles in its frame, which does not wait for paths.
TEST_F(Repaired, ABrighterLampIsShownBeforePathsAreTraced) {
  rest(SceneChanges::all());
  GiOutput out = step(edit([&](Scene& s) { s.find(lamp)->area->radiance *= 2.0f; }));
  EXPECT_TRUE(out.settled);
  EXPECT_FALSE(out.refined);
  EXPECT_EQ(out.stats.of("repair_rays"), 0.0);
  out = step();
  EXPECT_GT(out.stats.of("repair_rays"), 0.0);
}

// Paths tell what is seen; without them shadow maps become finer.
TEST_F(Repaired, TakesTheTimeOfFinerShadowMaps) {
  for (const bool repairs : {true, false}) {
    renderer = std::make_unique<FrameRenderer>(makeCpuBackend());
    double sharpened = 0.0;
    GiOutput out = step(SceneChanges::all(), repairs);
    for (int i = 0; i < 4000 && !out.settled; ++i) {
      out = step({}, repairs);
      sharpened += out.stats.of("maps_sharpened");
    }
    ASSERT_TRUE(out.settled);
    EXPECT_EQ(sharpened > 0.0, !repairs);
  }
}

TEST_F(Repaired, IsOffUnlessTheCallerAllowsIt) {
  const auto picture = rest(SceneChanges::all(), false).radiance;
  const GiOutput out = step({}, false);
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(out.stats.of("paths_repaired"), 0);
}

TEST_F(Repaired, DoesNothingOnceItIsDone) {
  const auto picture = rest(SceneChanges::all()).radiance;
  const GiOutput out = step();
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(out.stats.refineUpdates, 0);
  EXPECT_EQ(out.stats.of("repair_rays"), 0.0);
}

TEST_F(Repaired, EveryCarrierIsRepaired) {
  const Image reference = averageBlocks(test::renderReference(scene, view, 1024, kBounces), 4);
  settings.set("repair", 256);
  for (const char* carrier : {"samples", "meshes", "links", "imperfect", "field"}) {
    settings.set("indirect", std::string(carrier));
    const Metrics m = compareImages(averageBlocks(fresh(), 4), reference);
    RecordProperty(carrier, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.02) << carrier;
    EXPECT_NEAR(m.bias, 1.0, 0.01) << carrier;
  }
}

TEST_F(Repaired, EveryMethodIsRepaired) {
  const Image reference = averageBlocks(test::renderReference(scene, view, 1024, kBounces), 4);
  settings.reset("indirect");
  settings.set("repair", 256);
  for (const char* name : {"many_lights", "multi_mesh", "surface_shadow_maps",
                           "imperfect_shadow_maps", "light_field"}) {
    method = name;
    const Metrics m = compareImages(averageBlocks(fresh(), 4), reference);
    RecordProperty(name, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.02) << name;
    EXPECT_NEAR(m.bias, 1.0, 0.01) << name;
  }
}

TEST_F(Repaired, ScenesWithoutLightAreRepairedAtOnce) {
  Scene dark;
  test::addMesh(dark, test::squareMesh(2.0f));
  for (const Scene& s : {dark, Scene()}) {
    scene = s;
    EXPECT_EQ(test::meanOf(fresh()), scene.sky.radiance);
  }
}

}  // namespace
}  // namespace lamplighter
