// Shadow maps under a memory limit: only maps that the view looks up are rendered, and no more than
// fit.
#include <algorithm>
#include <iostream>

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

constexpr uint64_t kMebibyte = uint64_t{1} << 20;

Settings settingsOf(const std::string& technique, int vpls, int mebibytes) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("bounces", 1);
  s.set("updates", 200);
  s.set("antialias", 1);
  s.set("map_memory", mebibytes);
  return s;
}

// A map of 64² texels has 16 KiB: a mebibyte holds 64 of them.
TEST(MapMemory, TheLimitHoldsInEveryFrameAndThePictureIsCorrect) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    const test::AssetRoom room("pillar_room", 96, 60);
    FrameRenderer plenty(makeCpuBackend());
    const Image right = test::renderSettled(plenty, room.scene, SceneChanges::all(), room.view,
                                            settingsOf(technique, 1200, 256))
                            .radiance->pixels();
    FrameRenderer limited(makeCpuBackend());
    const Settings settings = settingsOf(technique, 1200, 4);
    GiOutput out;
    SceneChanges changes = SceneChanges::all();
    uint64_t most = 0;
    for (int frame = 0; frame < 100 && !out.settled; ++frame, changes = {}) {
      out = limited.render({room.scene, changes, room.view, "many_lights", settings});
      most = std::max(most, test::lightCounts(limited.backend()).mapBytes);
    }
    ASSERT_TRUE(out.settled);
    EXPECT_LE(most, 4 * kMebibyte);
    EXPECT_GT(most, 3 * kMebibyte);
    EXPECT_GT(out.stats.of("maps_without_room"), 0);
    const double error = compareImages(out.radiance->pixels(), right).relRmse;
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, 0.05);
    std::cout << technique << ": " << out.stats.of("maps_held") << " maps, "
              << out.stats.of("maps_without_room") << " without room, relRMSE " << 100.0 * error
              << "%\n";
  }
}

// Two closed rooms side by side, with a light and a box in each.
struct TwoRooms {
  Scene scene;
  View view;
  TwoRooms() {
    for (const float x : {-3.0f, 3.0f}) {
      test::addMesh(scene, test::roomMesh(vec3(4.0f)), vec3(x, 2, 0));
      test::addMesh(scene, test::boxMesh(vec3(0.8f)), vec3(x, 0.7f, 0));
      test::addRectangleLight(scene, vec3(x, 3.5f, 0.5f), vec2(1.0f), vec3(20));
    }
    look(-3.0f, 3.0f);
  }
  // From inside one room, facing x = `at`.
  void look(float from, float at) {
    view = test::lookAt(vec3(from + (at > from ? -1.5f : 1.5f), 1.6f, 0.3f), vec3(at, 1.0f, 0.0f),
                        96, 60);
  }
};

// The wall hides the other room although it lies in the view frustum. After moving to the other
// room, the picture equals a fresh render.
TEST(MapMemory, OnlyMapsThatTheViewLooksUpAreRendered) {
  TwoRooms rooms;
  FrameRenderer renderer(makeCpuBackend());
  const Settings settings = settingsOf("light_maps", 400, 256);
  const GiOutput first =
      test::renderSettled(renderer, rooms.scene, SceneChanges::all(), rooms.view, settings);
  EXPECT_GT(first.stats.of("maps_held"), first.stats.of("vpls") / 5);
  // A few VPLs near the floor of the other room also get a map: for them the database is not
  // certain that the bottoms of two walls hide everything.
  const auto lights = renderer.inspect().lights;
  const auto here = std::count_if(lights.begin(), lights.end(),
                                  [](const auto& l) { return l.vpl.position.x < 0.0f; });
  EXPECT_LE(first.stats.of("maps_held"), 11 * here / 10);
  FrameRenderer all(makeCpuBackend());
  const GiOutput naive = test::renderSettled(all, rooms.scene, SceneChanges::all(), rooms.view,
                                             settingsOf("naive", 400, 256));
  EXPECT_EQ(naive.stats.of("maps_held"), naive.stats.of("vpls"));
  EXPECT_LT(compareImages(first.radiance->pixels(), naive.radiance->pixels()).relRmse, 0.03);

  rooms.look(3.0f, -3.0f);
  const GiOutput other = test::renderSettled(renderer, rooms.scene, {}, rooms.view, settings);
  EXPECT_GT(other.stats.of("maps_held"), first.stats.of("maps_held"));  // both rooms' maps fit
  FrameRenderer fresh(makeCpuBackend());
  const GiOutput opened =
      test::renderSettled(fresh, rooms.scene, SceneChanges::all(), rooms.view, settings);
  EXPECT_LT(opened.stats.of("maps_held"), other.stats.of("maps_held"));
  EXPECT_TRUE(test::sameBits(other.radiance->pixels(), opened.radiance->pixels()));
}

// The camera moves between two rooms with memory for the maps of one. The limit holds in every
// frame. Only a few maps are rendered per frame, but no frame differs much from the settled
// picture, because light proxies replace missing maps.
TEST(MapMemory, ReplacingMapsCausesNoFlash) {
  TwoRooms rooms;
  FrameRenderer renderer(makeCpuBackend());
  // The lamp of the room in view has most of the samples, and memory must hold all their maps.
  Settings settings = settingsOf("light_maps", 210, 3);
  // Only maps change, neither the choice of light samples nor bias compensation of the settled
  // picture.
  settings.set("importance", 1);
  settings.set("bias_compensation", false);
  int framesWithProxies = 0;
  for (int visit = 0; visit < 6; ++visit) {
    settings.set("updates", visit == 0 ? 400 : 10);
    rooms.look(visit % 2 == 0 ? -3.0f : 3.0f, visit % 2 == 0 ? 3.0f : -3.0f);
    std::vector<Image> frames;
    GiOutput out;
    SceneChanges changes = visit == 0 ? SceneChanges::all() : SceneChanges();
    for (int frame = 0; frame < 200 && !out.settled; ++frame, changes = {}) {
      out = renderer.render({rooms.scene, changes, rooms.view, "many_lights", settings});
      EXPECT_LE(test::lightCounts(renderer.backend()).mapBytes, 3 * kMebibyte);
      if (visit > 0) {
        EXPECT_LE(out.stats.of("maps_rendered"), 10);
      }
      frames.push_back(out.radiance->pixels());
    }
    ASSERT_TRUE(out.settled);
    framesWithProxies += static_cast<int>(frames.size()) - 1;
    EXPECT_EQ(out.stats.of("maps_without_room"), 0);
    // In the first frame of a visit, possibly none of this room's lights has a map.
    for (size_t i = 1; i < frames.size(); ++i)
      EXPECT_LT(compareImages(frames[i], frames.back()).relRmse, 0.1) << visit << ", frame " << i;
  }
  EXPECT_GT(framesWithProxies, 6);
}

}  // namespace
}  // namespace lamplighter
