// The processor does not wait for the GPU in a drag.
#include <memory>

#include <gtest/gtest.h>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/registry/registry.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Room {
  Scene scene;
  NodeId cube, light;
  View view = test::lookAt(vec3(-2.5f, 2, 2.5f), vec3(1, 0.5f, -1.5f), 80, 60, 0.9f);
  Settings settings;

  Room() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    const int red = test::addMaterial(scene, vec3(0.9f, 0.05f, 0.05f));
    test::addMesh(scene, test::roomMesh(vec3(6, 4, 6), white), vec3(0, 2, 0));
    cube = test::addMesh(scene, test::boxMesh(vec3(1), red), vec3(0, 0.5f, 0));
    light = test::addRectangleLight(scene, vec3(0.5f, 3.8f, 0.5f), vec2(1, 0.8f), vec3(10));
    settings.set("vpls", 60);
    settings.set("updates", 20);
    settings.set("map_resolution", 32);
    settings.set("antialias", 2);
    settings.set("share_memory", 0);
  }
  SceneChanges move(NodeId node, const vec3& by) {
    const Scene before = scene;
    scene.find(node)->local.translation += by;
    return compare(before, scene);
  }
};

class GlWaits : public test::GlTest {};

TEST_F(GlWaits, ADragHasNone) {
  double time = 0.0;
  const Stopwatch clock = [&] { return time += 1e-3; };
  for (const char* technique : {"naive", "light_maps"}) {
    for (const LightPart part : {LightPart::all, LightPart::indirect}) {
      if (part == LightPart::indirect && technique == std::string("naive")) continue;
      SCOPED_TRACE(std::string(technique) + (part == LightPart::all ? "" : ", indirect"));
      Room room;
      room.settings.set("technique", std::string(technique));
      FrameRenderer renderer(makeGlBackend(), clock);
      const auto frame = [&](const SceneChanges& changes, const View& view) {
        return renderer.render({.scene = room.scene,
                                .changes = changes,
                                .view = view,
                                .method = "many_lights",
                                .settings = room.settings,
                                .part = part});
      };
      // The gains of corners are known once the picture is settled.
      int waits = 0;
      SceneChanges changes = SceneChanges::all();
      for (bool isSettled = false; !isSettled; changes = {}) {
        const GiOutput out = frame(changes, room.view);
        isSettled = out.settled;
        waits += static_cast<int>(out.stats.of("gl_waits"));
      }
      EXPECT_TRUE(waits > 0 || part == LightPart::indirect) << "antialiasing sums pictures";
      std::shared_ptr<RadianceImage> small;
      for (int step = 0; step < 6; ++step) {
        const NodeId node = step % 2 == 0 ? room.light : room.cube;
        const GiOutput out = frame(room.move(node, vec3(0.05f, 0, -0.04f)), room.view);
        EXPECT_FALSE(out.settled);
        EXPECT_EQ(out.stats.of("gl_waits"), 0.0) << step;
        const uint64_t before = renderer.backend().counts().waits;
        small = out.radiance->averaged(8);
        EXPECT_EQ(renderer.backend().counts().waits, before);
      }
      EXPECT_EQ(small->pixels().width, 10);
      View view = room.view;
      for (int step = 0; step < 3; ++step) {
        view.eye.x += 0.02f;
        EXPECT_EQ(frame({}, view).stats.of("gl_waits"), 0.0) << "flight " << step;
      }
    }
  }
}

TEST_F(GlWaits, OnlyWhatChangedIsSent) {
  Room room;
  room.settings.set("technique", std::string("light_maps"));
  FrameRenderer renderer(makeGlBackend());
  const auto frame = [&](const SceneChanges& changes) {
    return renderer.render({room.scene, changes, room.view, "many_lights", room.settings});
  };
  const double whole = frame(SceneChanges::all()).stats.of("gl_uploads");
  EXPECT_GT(whole, 10000.0);
  const auto settle = [&] {
    for (int i = 0; i < 300; ++i)
      if (frame({}).settled) return;
    FAIL() << "not settled";
  };
  settle();
  EXPECT_EQ(frame({}).stats.of("gl_uploads"), 0.0);
  const View view = room.view;
  room.view.eye.x += 1e-4f;
  const double flown = frame({}).stats.of("gl_uploads");
  EXPECT_LT(flown, 0.5 * whole) << "the camera sends no trees";
  room.view = view;
  settle();
  const double moved = frame(room.move(room.cube, vec3(0.05f, 0, 0))).stats.of("gl_uploads");
  EXPECT_GT(moved, 0.0);
  EXPECT_LT(moved, whole);
  settle();
  // The picture is that of a new backend, so nothing was left out.
  const Image picture = frame({}).radiance->pixels();
  const Image fresh = test::freshPicture(makeGlBackend(), room.scene, room.view, room.settings);
  EXPECT_EQ(picture.pixels, fresh.pixels);
}

// How stages are timed does not change the picture.
TEST_F(GlWaits, ExactTimesOfStagesWaitAndGiveTheSamePicture) {
  double time = 0.0;
  const Stopwatch clock = [&] { return time += 1e-3; };
  Room room;
  FrameRenderer late(makeGlBackend(), clock), exact(makeGlBackend(), clock, StageTimes::exact);
  const GiOutput out =
      exact.render({room.scene, SceneChanges::all(), room.view, "many_lights", room.settings});
  EXPECT_GT(out.stats.of("gl_waits"), 3.0);
  const Image picture = test::settledPicture(exact, room.scene, {}, room.view, room.settings);
  const Image other =
      test::settledPicture(late, room.scene, SceneChanges::all(), room.view, room.settings);
  EXPECT_EQ(picture.pixels, other.pixels);
}

TEST_F(GlWaits, PicturesAreCombinedOnTheGpuAsInMainMemory) {
  Room room;
  FrameRenderer renderer(makeGlBackend());
  const auto render = [&](const SceneChanges& changes) {
    return renderer.render({room.scene, changes, room.view, "many_lights", room.settings}).radiance;
  };
  Backend& backend = renderer.backend();
  const auto first = render(SceneChanges::all());
  Image gains(room.view.width, room.view.height);
  for (size_t i = 0; i < gains.pixels.size(); ++i)
    gains.pixels[i] = vec3(1.0f, 1.25f, 0.5f) + 0.001f * static_cast<float>(i);
  const auto kept = std::make_shared<const Image>(gains);
  const auto second = render(room.move(room.cube, vec3(0.3f, 0, 0)));
  const uint64_t before = backend.counts().waits;
  const auto product = backend.multiplied(first, kept);
  const auto rest = backend.difference(first, second);
  const auto small = first->averaged(7);
  EXPECT_EQ(backend.counts().waits, before);
  const auto host = [](const std::shared_ptr<RadianceImage>& picture) {
    return std::make_shared<HostImage>(picture->pixels());
  };
  EXPECT_EQ(product->pixels().pixels, backend.multiplied(host(first), kept)->pixels().pixels);
  EXPECT_EQ(rest->pixels().pixels, backend.difference(host(first), host(second))->pixels().pixels);
  EXPECT_GT(backend.counts().waits, before);
  const Image wanted = averageBlocks(first->pixels(), 7);
  ASSERT_EQ(small->width(), wanted.width);
  ASSERT_EQ(small->height(), wanted.height);
  for (size_t i = 0; i < wanted.pixels.size(); ++i)
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(small->pixels().pixels[i][c], wanted.pixels[i][c], 1e-5f * wanted.pixels[i][c]);
  // Other gains take their place.
  for (vec3& g : gains.pixels) g = vec3(2.0f);
  const auto doubled = backend.multiplied(first, std::make_shared<const Image>(gains));
  EXPECT_EQ(doubled->pixels().at(9, 9), 2.0f * first->pixels().at(9, 9));
}

TEST_F(GlWaits, TimesOfStagesComeLater) {
  Room room;
  FrameRenderer renderer(makeGlBackend());
  Backend& backend = renderer.backend();
  EXPECT_EQ(backend.stageSeconds(2), 0.0);
  backend.beginStages();
  renderer.render({room.scene, SceneChanges::all(), room.view, "many_lights", room.settings});
  backend.finish();
  backend.endStage(2);
  backend.finish();
  backend.beginStages();
  EXPECT_GT(backend.stageSeconds(2), 0.0);
  EXPECT_EQ(backend.stageSeconds(1), 0.0);
  EXPECT_EQ(backend.stageSeconds(7), 0.0);
  backend.endStage(7);
  for (int frame = 0; frame < 30; ++frame) {  // more than are measured at a time
    backend.beginStages();
    backend.endStage(1);
  }
}

}  // namespace
}  // namespace lamplighter
