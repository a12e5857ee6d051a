// many_lights as a whole, on the cpu backend.
#include "renderer/methods/many_lights/many_lights.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::lookAt;
using test::renderSettled;
using test::sameBits;

Settings settingsOf(int vpls, int bounces, int updates, int antialias = 1) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("bounces", bounces);
  s.set("updates", updates);
  s.set("antialias", antialias);
  s.set("map_resolution", 32);
  return s;
}

struct Room {
  Scene scene;
  NodeId box, light;
  View view = lookAt(vec3(2, 2.2f, 2.5f), vec3(-0.5f, 0.8f, -0.5f), 64, 48, 1.0f);

  Room() {
    const int white = test::addMaterial(scene, vec3(0.7f, 0.6f, 0.5f));
    test::addMesh(scene, test::roomMesh(vec3(6, 4, 6), white), vec3(0, 2, 0));
    box = test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(0, 0.5f, 0));
    light = test::addRectangleLight(scene, vec3(-0.5f, 3.5f, 0.5f), vec2(1, 0.6f), vec3(10, 8, 6));
  }
};

// Direct light of 1024 VPLs without occluders against the form factor of the polygon, E = π L F.
TEST(ManyLights, DirectLightIsThePolygonsFormFactor) {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(0.6f));
  test::addMesh(scene, test::squareMesh(10.0f, material));
  test::addRectangleLight(scene, vec3(0.5f, 2.0f, -0.3f), vec2(1.5f, 0.8f), vec3(7.0f));
  const std::vector<vec3> polygon{
      {-0.25f, 2, -0.7f}, {1.25f, 2, -0.7f}, {1.25f, 2, 0.1f}, {-0.25f, 2, 0.1f}};
  for (const vec3& x : {vec3(0), vec3(0.5f, 0, -0.3f), vec3(-2, 0, 1), vec3(3, 0, 3)}) {
    const View view = lookAt(x + vec3(0.3f, 1.0f, 0.4f), x, 8, 8, 0.01f);
    FrameRenderer renderer(makeCpuBackend());
    const double expected = 0.6 * 7.0 * test::polygonFormFactor(x, vec3(0, 1, 0), polygon);
    // A light map is exact at its texels. Between them, linear interpolation of a curved function
    // has an error.
    for (const auto& [technique, tolerance] : {std::pair("naive", 1e-3), {"light_maps", 2e-3}}) {
      Settings settings = settingsOf(1024, 0, 1024);
      settings.set("technique", std::string(technique));
      const GiOutput out = renderSettled(renderer, scene, SceneChanges::all(), view, settings);
      EXPECT_NEAR(static_cast<double>(test::meanOf(out.radiance->pixels()).r) / expected, 1.0,
                  tolerance)
          << x.x << " " << technique;
    }
  }
}

// With bounces, against the path tracer. The clamp distance is far below all distances that matter.
TEST(ManyLights, AgreesWithThePathTracer) {
  const Room room;
  Settings settings = settingsOf(4096, 2, 4096, 2);
  settings.set("map_resolution", 64);
  FrameRenderer renderer(makeCpuBackend());
  View view = room.view;
  view.width = 40;
  view.height = 30;
  const GiOutput out = renderSettled(renderer, room.scene, SceneChanges::all(), view, settings);
  const Image reference = test::renderReference(room.scene, view, 256, 2);
  const vec3 a = test::meanOf(out.radiance->pixels()), b = test::meanOf(reference);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i] / b[i], 1.0f, 0.02f) << i;
}

TEST(ManyLights, KeepsTheBudgetAndSettles) {
  Room room;
  FrameRenderer renderer(makeCpuBackend());
  Settings settings = settingsOf(100, 1, 30);
  settings.set("settled_map_scale", 1);
  const auto step = [&](const SceneChanges& changes) {
    return renderer.render({room.scene, changes, room.view, "many_lights", settings});
  };
  GiOutput out = step(SceneChanges::all());
  EXPECT_EQ(out.stats.of("vpls_refreshed"), 30);
  EXPECT_EQ(out.stats.of("vpls"), 30);
  EXPECT_EQ(out.stats.of("vpls_pending"), 70);
  EXPECT_FALSE(out.settled);
  EXPECT_EQ(step({}).stats.of("vpls_pending"), 40);
  EXPECT_EQ(step({}).stats.of("vpls_pending"), 10);
  out = step({});
  EXPECT_TRUE(out.settled);
  EXPECT_EQ(out.stats.of("vpls_refreshed"), 10);
  // Some lights are visible or hidden everywhere in the view, so they need no map.
  const uint64_t maps = test::lightCounts(renderer.backend()).shadowMaps;
  EXPECT_GT(maps, 80u);
  EXPECT_LE(maps, 100u);
  EXPECT_EQ(static_cast<uint64_t>(out.stats.of("maps_held")), maps);

  // Without changes there is no work and the same picture.
  const uint64_t sums = test::lightCounts(renderer.backend()).lightPixels;
  const auto picture = out.radiance;
  out = step({});
  EXPECT_TRUE(out.settled);
  EXPECT_EQ(out.radiance, picture);
  EXPECT_EQ(test::lightCounts(renderer.backend()).lightPixels, sums);
  EXPECT_EQ(test::lightCounts(renderer.backend()).shadowMaps, maps);

  // Another view needs new sums, and the maps that only this view looks up.
  room.view.eye.x += 0.1f;
  EXPECT_FALSE(step({}).settled) << "fewer samples while the camera moves";
  EXPECT_TRUE(step({}).settled);
  EXPECT_GT(test::lightCounts(renderer.backend()).lightPixels, sums);
  EXPECT_GE(test::lightCounts(renderer.backend()).shadowMaps, maps);
  EXPECT_LE(test::lightCounts(renderer.backend()).shadowMaps, 100u);
}

// While the light moves, the brightness of each frame lies between that of the old and the new
// VPLs, and the picture settles.
TEST(ManyLights, AMoveDoesNotFlicker) {
  Room room;
  FrameRenderer renderer(makeCpuBackend());
  Settings settings = settingsOf(120, 0, 17);
  settings.set("settled_map_scale", 1);
  const float before =
      test::meanOf(renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings)
                       .radiance->pixels())
          .g;
  const Scene old = room.scene;
  room.scene.find(room.light)->local.translation += vec3(1.2f, -0.8f, -1.0f);
  std::vector<float> means;
  SceneChanges changes = compare(old, room.scene);
  for (int frame = 0; frame < 8; ++frame) {
    const GiOutput out = renderer.render({room.scene, changes, room.view, "many_lights", settings});
    changes = {};
    means.push_back(test::meanOf(out.radiance->pixels()).g);
    EXPECT_EQ(out.settled, frame == 7);
  }
  const float after = means.back();
  ASSERT_GT(std::abs(after - before), 0.02f * before);
  // The emitting surface itself moves at once. The light that it emits follows over seven frames.
  const float slack = 0.05f * before;
  for (const float mean : means) {
    EXPECT_GT(mean, std::min(before, after) - slack);
    EXPECT_LT(mean, std::max(before, after) + slack);
  }
}

// A settled picture does not depend on earlier edits: it equals that of the newly opened scene.
TEST(ManyLights, SettledAfterManyMovesEqualsAFreshRender) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    Room room;
    FrameRenderer renderer(makeCpuBackend());
    Settings settings = settingsOf(90, 2, 20, 2);
    settings.set("technique", std::string(technique));
    SceneChanges changes = SceneChanges::all();
    NodeId second = kNoNode;
    for (int move = 0; move < 12; ++move) {
      // The renderer does not settle between the edits.
      renderer.render({room.scene, changes, room.view, "many_lights", settings});
      const Scene old = room.scene;
      const float t = static_cast<float>(move);
      if (move % 3 == 0) room.scene.find(room.light)->local.translation.x += 0.1f * t;
      if (move % 3 == 1) room.scene.find(room.box)->local.translation.z -= 0.07f * t;
      if (move == 5) {
        second = test::addRectangleLight(room.scene, vec3(1, 2, -1), vec2(0.4f), vec3(3, 9, 3));
      }
      if (move == 8) room.scene.find(second)->area->radiance = vec3(1, 5, 2);
      if (move == 9) room.view.eye.y += 0.2f;
      if (move == 10) room.scene.find(room.light)->visible = false;
      if (move == 11) room.scene.find(room.light)->visible = true;
      changes = compare(old, room.scene);
    }
    const GiOutput moved = renderSettled(renderer, room.scene, changes, room.view, settings);
    FrameRenderer fresh(makeCpuBackend());
    const GiOutput opened =
        renderSettled(fresh, room.scene, SceneChanges::all(), room.view, settings);
    EXPECT_EQ(moved.stats.of("vpls"), opened.stats.of("vpls"));
    EXPECT_TRUE(sameBits(moved.radiance->pixels(), opened.radiance->pixels()));
  }
}

// Where one light is all light, its samples stay where they are when it gets brighter: the next
// frame is exact, without look-ups of occluders and without shadow maps.
TEST(ManyLights, TheFrameAfterAChangeOfBrightnessIsExact) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    Room room;
    FrameRenderer renderer(makeCpuBackend());
    Settings settings = settingsOf(90, 2, 90);
    settings.set("technique", std::string(technique));
    const Image before =
        renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings)
            .radiance->pixels();
    const Scene old = room.scene;
    room.scene.find(room.light)->area->radiance *= 2.0f;
    const GiOutput next =
        renderer.render({room.scene, compare(old, room.scene), room.view, "many_lights", settings});
    EXPECT_EQ(next.stats.of("visibility_tests"), 0.0);
    EXPECT_EQ(next.stats.of("maps_rendered"), 0.0);
    EXPECT_EQ(next.stats.of("paths_walked"), 0.0);
    const Image& after = next.radiance->pixels();
    for (size_t i = 0; i < before.pixels.size(); ++i) {
      const vec3 wanted = 2.0f * before.pixels[i];
      for (int c = 0; c < 3; ++c) EXPECT_NEAR(after.pixels[i][c], wanted[c], 1e-5f * wanted[c]);
    }
    const Image settled =
        renderSettled(renderer, room.scene, {}, room.view, settings).radiance->pixels();
    FrameRenderer fresh(makeCpuBackend());
    EXPECT_TRUE(
        sameBits(settled, renderSettled(fresh, room.scene, SceneChanges::all(), room.view, settings)
                              .radiance->pixels()));
  }
}

// A changed setting changes the picture; changing it back restores the bits.
TEST(ManyLights, RestoredSettingsGiveTheSameBits) {
  const Room room;
  FrameRenderer renderer(makeCpuBackend());
  Settings settings = settingsOf(60, 1, 50, 3);
  const Image first = renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings)
                          .radiance->pixels();
  const auto differs = [&](const char* name, const ParameterValue& value) {
    const Settings before = settings;
    settings.set(name, value);
    const Image changed =
        renderSettled(renderer, room.scene, {}, room.view, settings).radiance->pixels();
    EXPECT_FALSE(sameBits(first, changed)) << name;
    settings = before;
    const Image back =
        renderSettled(renderer, room.scene, {}, room.view, settings).radiance->pixels();
    EXPECT_TRUE(sameBits(first, back)) << name;
  };
  differs("vpls", 200);
  differs("direct_share", 0.9f);
  differs("bounces", 3);
  differs("seed", 7);
  differs("map_resolution", 17);
  differs("settled_map_scale", 2);
  differs("clamp_distance", 1.5f);
  differs("shadow_bias", 0.1f);
  differs("antialias", 1);
}

TEST(ManyLights, HasTheSameBitsAtAnyNumberOfThreads) {
  const Room room;
  std::vector<Image> images;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    FrameRenderer renderer(makeCpuBackend());
    images.push_back(renderSettled(renderer, room.scene, SceneChanges::all(), room.view,
                                   settingsOf(80, 2, 33, 2))
                         .radiance->pixels());
  }
  EXPECT_TRUE(sameBits(images[0], images[1]));
  EXPECT_TRUE(sameBits(images[0], images[2]));
}

TEST(ManyLights, ASceneWithoutLightIsBlackAndSettles) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(2.0f));
  FrameRenderer renderer(makeCpuBackend());
  const View view = lookAt(vec3(0, 3, 1), vec3(0), 8, 8);
  const GiOutput out =
      renderSettled(renderer, scene, SceneChanges::all(), view, settingsOf(10, 1, 10));
  EXPECT_EQ(test::meanOf(out.radiance->pixels()), vec3(0.0f));
  Scene empty;
  FrameRenderer none(makeCpuBackend());
  renderSettled(none, empty, SceneChanges::all(), view, settingsOf(10, 1, 10));
}

}  // namespace
}  // namespace lamplighter
