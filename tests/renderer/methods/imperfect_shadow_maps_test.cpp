// The method of paper 2: samples chosen for the view, with shadow maps of points.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/imperfect_light/imperfect_views.h"
#include "tests/support/scenes/method_room.h"

namespace lamplighter {
namespace {

struct ImperfectRoom : test::MethodRoom {
  ImperfectRoom() : MethodRoom("imperfect_shadow_maps") {
    settings.set("bounced_samples", 256);
    settings.set("potential_lights", 4096);
    settings.set("occluder_points", 1024);
    settings.set("settled_resolution", 64);
    settings.set("antialias", 2);
  }

  Image reference() { return averageBlocks(test::renderReference(scene, view, 1024, 2), 4); }
};

TEST(ImperfectShadowMaps, SettlesNearTheReference) {
  ImperfectRoom room;
  room.settings.set("bounced_samples", 1024);
  room.settings.set("antialias", 8);
  room.settings.set("settled_resolution", 128);
  const Metrics m = compareImages(averageBlocks(room.fresh(), 4), room.reference());
  RecordProperty("relRmse", std::to_string(m.relRmse));
  RecordProperty("bias", std::to_string(m.bias));
  EXPECT_LT(m.relRmse, 0.04);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.03);
}

// The picture of each frame, with interleaved samples and maps of points.
TEST(ImperfectShadowMaps, TheFirstFrameIsNearTheReference) {
  ImperfectRoom room;
  room.settings.set("bounced_samples", 1024);
  room.settings.set("occluder_points", 4096);
  const GiOutput out = room.frame(SceneChanges::all());
  EXPECT_FALSE(out.settled);
  const Metrics m = compareImages(averageBlocks(out.radiance->pixels(), 4), room.reference());
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.12);
}

TEST(ImperfectShadowMaps, EditsLeaveTheBitsOfAFreshStart) {
  ImperfectRoom room;
  const Image before = room.picture(SceneChanges::all());
  const auto expectFresh = [&](const Image& now) {
    EXPECT_TRUE(test::sameBits(now, room.fresh()));
  };
  expectFresh(
      room.edited([&](Scene& s) { s.find(room.lamp)->area->radiance *= vec3(0.5f, 0.7f, 0.1f); }));
  room.edited([&](Scene& s) { s.find(room.lamp)->area->radiance = vec3(5.0f); });
  expectFresh(room.edited([&](Scene& s) { s.find(room.lamp)->local.translation.x += 0.5f; }));
  room.edited([&](Scene& s) { s.find(room.lamp)->local.translation.x -= 0.5f; });
  expectFresh(room.edited([&](Scene& s) { s.find(room.box)->local.translation.z += 0.5f; }));
  // A drag of several frames, and back.
  for (int step = 0; step < 5; ++step)
    room.frame(room.edit([&](Scene& s) { s.find(room.box)->local.translation.z -= 0.1f; }));
  const Scene moved = room.scene;
  room.scene.find(room.box)->local.translation.z = 0.0f;
  const Image back = room.picture(compare(moved, room.scene));
  expectFresh(back);
  EXPECT_TRUE(test::sameBits(back, before));
}

TEST(ImperfectShadowMaps, DoesNotDependOnThreadsOrTheWayOfTheCamera) {
  ImperfectRoom room;
  const Image before = room.picture(SceneChanges::all());
  const View view = room.view;
  for (int i = 0; i < 4; ++i) {
    room.view.eye.x += 0.4f;
    room.frame({});
  }
  room.view = view;
  EXPECT_TRUE(test::sameBits(before, room.picture()));
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(test::sameBits(before, room.fresh()));
}

// The window changes the budget of each frame.
TEST(ImperfectShadowMaps, SettlesWhileTheBudgetChanges) {
  ImperfectRoom room;
  const Image expected = room.fresh();
  GiOutput out = room.frame(SceneChanges::all());
  for (int i = 0; i < 300 && !out.settled; ++i) {
    room.settings.set("updates", 50 + i % 7);
    out = room.frame({});
  }
  ASSERT_TRUE(out.settled);
  EXPECT_TRUE(test::sameBits(out.radiance->pixels(), expected));
}

// Sizes of maps and numbers of points that are no powers of two.
TEST(ImperfectShadowMaps, SettlesWithAnySizes) {
  ImperfectRoom room;
  room.settings.set("imperfect_resolution", 50);
  room.settings.set("occluder_points", 1000);
  room.settings.set("settled_resolution", 50);
  room.settings.set("interleave", 3);
  room.settings.set("bounced_samples", 100);
  room.picture(SceneChanges::all());
}

TEST(ImperfectShadowMaps, WorksAsPublished) {
  ImperfectRoom room;
  room.settings.set("as_published", true);
  room.settings.set("bounced_samples", 1024);
  const Metrics m = compareImages(averageBlocks(room.fresh(), 4), room.reference());
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.25);
}

TEST(ImperfectShadowMaps, ShowsItsViews) {
  ImperfectRoom room;
  room.frame(SceneChanges::all());
  const Inspection shown = room.renderer.inspect();
  for (const MethodView& view : imperfectViews()) {
    const ViewPicture picture = shown.pictures.at(view.name)();
    EXPECT_EQ(picture.problem, "") << view.name;
    EXPECT_EQ(picture.image.width, room.view.width);
    bool isEven = true;
    for (int x = 1; x < picture.image.width; ++x)
      for (int y = 0; y < picture.image.height; ++y)
        isEven &= picture.image.at(x, y)[0] == picture.image.at(0, 0)[0];
    EXPECT_FALSE(isEven) << view.name;
  }
}

TEST(ImperfectShadowMaps, ShowsOnlyAPartOfTheLight) {
  ImperfectRoom room;
  room.settings.set("antialias", 1);
  const auto part = [&](LightPart shown) {
    FrameRenderer own(makeCpuBackend());
    SceneChanges changes = SceneChanges::all();
    GiOutput out;
    for (int i = 0; i < 3000 && !out.settled; ++i) {
      out = own.render({.scene = room.scene,
                        .changes = changes,
                        .view = room.view,
                        .method = "imperfect_shadow_maps",
                        .settings = room.settings,
                        .part = shown});
      changes = {};
    }
    return out.radiance->pixels();
  };
  const Image all = part(LightPart::all), direct = part(LightPart::direct),
              indirect = part(LightPart::indirect);
  const float sum = test::meanOf(direct).g + test::meanOf(indirect).g;
  EXPECT_GT(test::meanOf(indirect).g, 0.05f * test::meanOf(all).g);
  EXPECT_NEAR(sum, test::meanOf(all).g, 0.01f * sum);
}

// The same light, at the default values of its parameters.
TEST(ImperfectShadowMaps, IsACarrierOfBouncedLightOfManyLights) {
  ImperfectRoom room;
  room.settings = Settings();
  room.settings.set("antialias", 2);
  const Image own = room.fresh();
  room.settings.set("indirect", std::string("imperfect"));
  FrameRenderer renderer(makeCpuBackend());
  const Image carried =
      test::settledPicture(renderer, room.scene, SceneChanges::all(), room.view, room.settings);
  EXPECT_TRUE(test::sameBits(own, carried));
}

}  // namespace
}  // namespace lamplighter
