// The path tracer as a method: the picture depends on the input only, and every change restarts it.
#include "renderer/methods/path_tracer/reference_method.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene litRoom() {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.6f, 0.5f, 0.4f));
  const int metal = test::addMaterial(scene, vec3(0.8f, 0.7f, 0.6f), 1.0f, 0.3f);
  test::addMesh(scene, test::squareMesh(6.0f, grey));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), metal), vec3(0.3f, 0.5f, 0.0f));
  test::addRectangleLight(scene, vec3(0, 3, 0), vec2(1.0f), vec3(8.0f));
  scene.sky = vec3(0.2f, 0.3f, 0.4f);
  return scene;
}

View litRoomView() { return test::lookAt(vec3(2, 2.5f, 4), vec3(0, 0.5f, 0), 37, 23); }

Settings settingsOf(int samples, int perFrame, int bounces = 2, int seed = 1) {
  Settings settings;
  settings.set("samples_per_pixel", samples);
  settings.set("samples_per_frame", perFrame);
  settings.set("bounces", bounces);
  settings.set("seed", seed);
  return settings;
}

// The frames until the picture is settled. Changes are passed to the first frame only.
struct Rendered {
  Image image;
  int frames = 0;
  uint64_t rays = 0;
};

Rendered settle(FrameRenderer& renderer, const Scene& scene, SceneChanges changes, const View& view,
                const Settings& settings) {
  Rendered r;
  for (; r.frames < 100; changes = {}) {
    ++r.frames;
    const GiOutput out = renderer.render({scene, changes, view, "reference", settings});
    r.rays += out.stats.raysTraced;
    if (!out.settled) continue;
    r.image = out.radiance->pixels();
    return r;
  }
  ADD_FAILURE() << "not settled";
  return r;
}

Rendered fresh(const Scene& scene, const View& view, const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  return settle(renderer, scene, SceneChanges::all(), view, settings);
}

TEST(ReferenceMethod, GivesTheSameBitsAtAnyNumberOfThreads) {
  const auto withThreads = [](int threads, bool glossyBounces) {
    const tbb::global_control atMost(tbb::global_control::max_allowed_parallelism,
                                     static_cast<size_t>(threads));
    tbb::task_arena arena(threads);
    Settings settings = settingsOf(4, 4);
    settings.set("glossy_bounces", glossyBounces);
    return arena.execute([&] { return fresh(litRoom(), litRoomView(), settings); });
  };
  for (const bool glossyBounces : {false, true}) {
    const Rendered one = withThreads(1, glossyBounces);
    for (const int threads : {2, 5}) {
      const Rendered many = withThreads(threads, glossyBounces);
      EXPECT_TRUE(test::sameBits(one.image, many.image)) << threads;
      EXPECT_EQ(one.rays, many.rays) << threads;
    }
  }
}

TEST(ReferenceMethod, TheDistributionOverFramesDoesNotChangeBits) {
  const Rendered whole = fresh(litRoom(), litRoomView(), settingsOf(7, 64));
  const Rendered split = fresh(litRoom(), litRoomView(), settingsOf(7, 2));
  EXPECT_EQ(whole.frames, 1);
  EXPECT_EQ(split.frames, 4);
  EXPECT_TRUE(test::sameBits(whole.image, split.image));
  EXPECT_EQ(whole.rays, split.rays);
  EXPECT_GT(whole.rays, uint64_t{37 * 23 * 7});
}

TEST(ReferenceMethod, AnotherSeedIsAnotherPicture) {
  EXPECT_FALSE(test::sameBits(fresh(litRoom(), litRoomView(), settingsOf(2, 2, 2, 1)).image,
                              fresh(litRoom(), litRoomView(), settingsOf(2, 2, 2, 2)).image));
}

// After any change, the picture equals that of a new renderer.
TEST(ReferenceMethod, RestartsWhenAnythingChanges) {
  FrameRenderer renderer(makeCpuBackend());
  Scene scene = litRoom();
  View view = litRoomView();
  Settings settings = settingsOf(3, 1);
  settle(renderer, scene, SceneChanges::all(), view, settings);

  const auto expectFresh = [&](const SceneChanges& changes, const char* what) {
    const Image next = settle(renderer, scene, changes, view, settings).image;
    EXPECT_TRUE(test::sameBits(next, fresh(scene, view, settings).image)) << what;
  };
  const auto edit = [&](auto change, const char* what) {
    const Scene before = scene;
    change(scene);
    expectFresh(compare(before, scene), what);
  };
  edit([](Scene& s) { s.nodes[1].local.translation.x += 0.4f; }, "object moved");
  edit([](Scene& s) { s.nodes[2].local.translation.z += 0.4f; }, "light moved");
  edit([](Scene& s) { s.nodes[2].area->radiance *= 2.0f; }, "light brighter");
  edit([](Scene& s) { s.materials[0].baseColor.g = 0.1f; }, "material");
  edit([](Scene& s) { s.sky = vec3(1.0f, 0.1f, 0.1f); }, "sky");
  edit([](Scene& s) { s.nodes[1].visible = false; }, "object hidden");
  view.eye.x += 0.3f;
  expectFresh({}, "view");
  settings = settingsOf(3, 1, 1);
  expectFresh({}, "bounces");
  settings = settingsOf(3, 1, 1, 9);
  expectFresh({}, "seed");
  settings.set("glossy_bounces", true);
  expectFresh({}, "glossy bounces");
  settings = settingsOf(2, 1, 1, 9);
  expectFresh({}, "fewer paths");
  settings = settingsOf(5, 1, 1, 9);
  expectFresh({}, "more paths");
}

}  // namespace
}  // namespace lamplighter
