// The method of paper 5: bounced light and the light of the sky in a light field.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/metrics.h"
#include "tests/support/scenes/method_room.h"

namespace lamplighter {
namespace {

struct LitField : test::MethodRoom {
  LitField() : MethodRoom("light_field", "field_samples") {
    settings.set("field_texel", 0.3f);
    settings.set("field_directions", std::string("129"));
    settings.set("field_sets", 2);
  }
  // No ceiling, no lamp: light of the sky alone.
  void openToTheSky() {
    scene.find(lamp)->visible = false;
    scene.nodes.front().visible = false;
    test::addMesh(scene, test::squareMesh(4.0f, 0), vec3(0.0f, -1.5f, 0.0f));
    scene.sky = Sky(vec3(1.0f));
  }
};

TEST(LightFieldMethod, IsNearTheReference) {
  LitField room;
  room.settings.set("field_texel", 0.15f);
  room.settings.set("field_directions", std::string("513"));
  room.settings.set("antialias", 16);
  const Metrics m = room.freshAgainstReference();
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.03);
}

TEST(LightFieldMethod, EditsLeaveTheBitsOfAFreshStart) {
  for (const std::string sight : {"lines", "rays"}) {
    LitField room;
    room.settings.set("field_sight", sight);
    room.expectEditsLeaveFreshBits();
  }
}

TEST(LightFieldMethod, EditsOfMaterialsLeaveTheBitsOfAFreshStart) {
  LitField room;
  room.settings.set("field_sets", 1);
  room.expectMaterialEditsLeaveFreshBits();
}

TEST(LightFieldMethod, ThePictureDoesNotDependOnThreadsOrFrames) {
  LitField room;
  const Image expected = room.fresh();
  room.settings.set("updates", 3);
  EXPECT_TRUE(test::sameBits(room.fresh(), expected));
  room.settings.reset("updates");
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(test::sameBits(room.fresh(), expected));
}

// What texels see is kept, so that lamps cost nothing but their direct light.
TEST(LightFieldMethod, LampsFindNothingAnew) {
  LitField room;
  room.settings.set("field_sets", 1);
  room.picture(SceneChanges::all());
  EXPECT_GT(room.count, 0.0);
  room.edited([&](Scene& s) { s.find(room.lamp)->local.translation.x += 0.2f; });
  EXPECT_EQ(room.count, 0.0);
  room.edited([&](Scene& s) { s.find(room.lamp)->area->radiance *= 2.0f; });
  EXPECT_EQ(room.count, 0.0);
}

TEST(LightFieldMethod, LightOfTheSkyIsNearTheReference) {
  LitField room;
  room.settings.set("field_directions", std::string("513"));
  room.openToTheSky();
  const Image reference = test::renderReference(room.scene, room.view, 256, 2);
  const Metrics m = compareImages(averageBlocks(room.fresh(), 4), averageBlocks(reference, 4));
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.02);
  // Another sky needs no new partners.
  room.settings.set("field_sets", 1);
  room.picture(SceneChanges::all());
  const Image dimmed = room.edited([](Scene& s) { s.sky = Sky(vec3(0.2f, 0.4f, 0.8f)); });
  EXPECT_EQ(room.count, 0.0);
  EXPECT_TRUE(test::sameBits(dimmed, room.fresh()));
}

// A convex object under an even sky: πL whatever the number of directions.
TEST(LightFieldMethod, AnEvenSkyGivesExactlyPiL) {
  for (const std::string directions : {"33", "513"}) {
    LitField room;
    room.settings.set("field_directions", directions);
    room.scene.find(room.lamp)->visible = false;
    room.scene.nodes.front().visible = false;
    room.scene.sky = Sky(vec3(2.0f));
    room.settings.set("antialias", 1);
    const Image shown = room.freshPart(LightPart::all, true);
    // White surfaces show the radiance of the sky.
    for (const vec3& p : shown.pixels) EXPECT_NEAR(p.g, 2.0f, 2e-4f);
  }
}

// Lamps that send their light along the field, as published.
TEST(LightFieldMethod, LampsInTheFieldAreNearTheReference) {
  LitField room;
  room.settings.set("field_lamps", true);
  room.settings.set("field_texel", 0.15f);
  room.settings.set("field_directions", std::string("513"));
  room.settings.set("field_sets", 16);
  const Metrics m = room.freshAgainstReference();
  EXPECT_LT(m.relRmse, 0.08);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.03);
}

// Area lights block light then, and they move like other objects.
TEST(LightFieldMethod, EditsOfLampsInTheFieldLeaveTheBitsOfAFreshStart) {
  LitField room;
  room.settings.set("field_lamps", true);
  room.picture(SceneChanges::all());
  const Image dimmed =
      room.edited([&](Scene& s) { s.find(room.lamp)->area->radiance *= vec3(0.5f, 0.7f, 0.1f); });
  EXPECT_TRUE(test::sameBits(dimmed, room.fresh()));
  const Image moved =
      room.edited([&](Scene& s) { s.find(room.lamp)->local.translation.x += 0.5f; });
  EXPECT_TRUE(test::sameBits(moved, room.fresh()));
  const Image off = room.edited([&](Scene& s) { s.find(room.lamp)->visible = false; });
  EXPECT_TRUE(test::sameBits(off, room.fresh()));
  room.settings.set("field_lamps", false);
  EXPECT_TRUE(test::sameBits(room.picture(), room.fresh()));
}

// The same area of lamps in one piece or in many: as many rays, samples and crossings.
TEST(LightFieldMethod, ManyLampsCostNoMoreThanOne) {
  const auto costOf = [](int lamps) {
    LitField room;
    room.settings.set("field_lamps", true);
    room.settings.set("field_sets", 1);
    room.scene.find(room.lamp)->visible = false;
    for (int k = 0; k < lamps; ++k)
      test::addRectangleLight(room.scene,
                              vec3(-0.9f + 0.2f * static_cast<float>(k % 10), 0.7f,
                                   -0.9f + 0.2f * static_cast<float>(k / 10)),
                              vec2(0.05f), vec3(100.0f));
    SceneChanges changes = SceneChanges::all();
    double rays = 0.0, samples = 0.0;
    GiOutput out;
    do {
      out = room.renderer.render({room.scene, changes, room.view, "light_field", room.settings});
      rays += out.stats.of("field_rays");
      samples += out.stats.of("field_samples");
      changes = {};
    } while (!out.settled);
    return std::pair(rays, samples);
  };
  const auto one = costOf(1), many = costOf(100);
  EXPECT_EQ(one.second, many.second);
  EXPECT_LT(many.first, 1.05 * one.first);
}

TEST(LightFieldMethod, IsManyLightsWithAField) {
  LitField room;
  const Image field = room.fresh();
  room.settings.set("indirect", std::string("field"));
  EXPECT_TRUE(test::sameBits(room.fresh("many_lights"), field));
}

// The parts of the light add up.
TEST(LightFieldMethod, DirectAndIndirectLightAreAll) {
  LitField room;
  room.openToTheSky();
  room.settings.set("antialias", 1);
  room.settings.set("field_sets", 1);
  Image sum = room.freshPart(LightPart::direct);
  const Image indirect = room.freshPart(LightPart::indirect), all = room.freshPart(LightPart::all);
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  EXPECT_LT(compareImages(sum, all).relRmse, 1e-4);
  // As much of it bounced as in the reference.
  const auto bounces = [&](int count) {
    return test::meanOf(test::renderReference(room.scene, room.view, 1024, count)).g;
  };
  const float expected = bounces(2) - bounces(0);
  EXPECT_NEAR(test::meanOf(indirect).g, expected, 0.2f * expected);
}

TEST(LightFieldMethod, ViewsShowTheField) {
  LitField room;
  room.picture(SceneChanges::all());
  const Inspection inspection = room.renderer.inspect();
  for (const std::string name :
       {"field_texels", "field_lines", "field_direction", "field_incident"}) {
    const ViewPicture view = inspection.pictures.at(name)();
    EXPECT_EQ(view.problem, "");
    EXPECT_FALSE(view.legend.empty() && view.legend.title.empty());
    int shown = 0, pixels = room.view.width * room.view.height;
    for (size_t i = 0; i < view.image.pixels.size(); i += 4)
      shown += view.image.pixels[i] + view.image.pixels[i + 1] + view.image.pixels[i + 2] > 0;
    EXPECT_GT(shown, pixels / 10) << name;
  }
}

}  // namespace
}  // namespace lamplighter
