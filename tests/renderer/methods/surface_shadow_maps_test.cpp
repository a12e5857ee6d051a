// The method of paper 3: bounced light along kept links.
#include <filesystem>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/image/metrics.h"
#include "tests/support/scenes/method_room.h"

namespace lamplighter {
namespace {

struct BouncedRoom : test::MethodRoom {
  BouncedRoom() : MethodRoom("surface_shadow_maps", "texel_rays") {
    settings.set("texel", 0.4f);
    settings.set("depth_map", std::string("cube"));
    settings.set("depth_resolution", 16);
  }
};

TEST(SurfaceShadowMaps, IsNearTheReference) {
  BouncedRoom room;
  room.settings.set("texel", 0.2f);
  room.settings.set("depth_resolution", 32);
  room.settings.set("antialias", 16);
  const Metrics m = room.freshAgainstReference();
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_LT(std::abs(m.bias - 1.0), 0.03);
}

TEST(SurfaceShadowMaps, StoredVisibilityShowsWhatRaysShow) {
  BouncedRoom room;
  room.settings.set("depth_resolution", 32);
  const Image stored = room.fresh();
  room.settings.set("link_visibility", std::string("rays"));
  EXPECT_LT(compareImages(stored, room.fresh()).relRmse, 0.01);
}

TEST(SurfaceShadowMaps, EditsLeaveTheBitsOfAFreshStart) {
  BouncedRoom room;
  room.expectEditsLeaveFreshBits();
}

// The old light is kept, and moves with the object, until its links are computed again.
TEST(SurfaceShadowMaps, AnObjectThatMovesKeepsItsLight) {
  BouncedRoom room;
  room.settings.set("antialias", 1);
  const auto indirect = [&](const SceneChanges& changes) {
    return room.renderer.render({.scene = room.scene,
                                 .changes = changes,
                                 .view = room.view,
                                 .method = "surface_shadow_maps",
                                 .settings = room.settings,
                                 .part = LightPart::indirect});
  };
  SceneChanges changes = SceneChanges::all();
  while (!indirect(changes).settled) changes = {};
  Image moving;
  for (int step = 0; step < 8; ++step) {
    const Scene old = room.scene;
    room.scene.find(room.box)->local.translation.z += 0.1f;
    const GiOutput out = indirect(compare(old, room.scene));
    EXPECT_FALSE(out.settled);
    moving = out.radiance->pixels();
  }
  GiOutput settled;
  do settled = indirect({});
  while (!settled.settled);
  const double error = compareImages(moving, settled.radiance->pixels()).relRmse;
  EXPECT_LT(error, 0.1);
  EXPECT_TRUE(test::sameBits(room.picture(), room.fresh()));
}

TEST(SurfaceShadowMaps, EditsOfMaterialsLeaveTheBitsOfAFreshStart) {
  BouncedRoom room;
  room.expectMaterialEditsLeaveFreshBits();
}

// With rays nothing waits for depths.
TEST(SurfaceShadowMaps, IsPreparedInTheEnd) {
  for (const std::string visibility : {"stored", "rays"}) {
    BouncedRoom room;
    room.settings.set("link_visibility", visibility);
    FrameRenderer renderer(makeCpuBackend());
    SceneChanges changes = SceneChanges::all();
    GiOutput out;
    for (int frame = 0; frame < 3000 && !out.settled; ++frame) {
      out = renderer.render({room.scene, changes, room.view, "surface_shadow_maps", room.settings});
      changes = {};
    }
    EXPECT_EQ(out.stats.of("prepared"), 100.0) << visibility;
    EXPECT_EQ(out.stats.of("depth_segments") > 0.0, visibility == "stored");
  }
}

TEST(SurfaceShadowMaps, ViewsShowWhatIsFound) {
  BouncedRoom room;
  room.settings.set("updates", 1);
  room.settings.set("texel", 0.2f);
  room.renderer.render(
      {room.scene, SceneChanges::all(), room.view, "surface_shadow_maps", room.settings});
  const auto draw = [&](const std::string& name) {
    return room.renderer.inspect().pictures.at(name)();
  };
  const auto countOf = [](const ViewPicture& picture, const vec3& colour) {
    int count = 0;
    for (size_t i = 0; i < picture.image.pixels.size(); i += 4) {
      bool isSame = true;
      for (size_t c = 0; c < 3; ++c)
        isSame = isSame && picture.image.pixels[i + c] ==
                               static_cast<uint8_t>(255.0f * colour[static_cast<int>(c)]);
      count += isSame ? 1 : 0;
    }
    return count;
  };
  const int pixels = room.view.width * room.view.height;
  const ViewPicture before = draw("pending_links");
  ASSERT_EQ(before.legend.swatches.size(), 3u);
  const vec3 found = before.legend.swatches[0].colour;
  const vec3 missing = before.legend.swatches[2].colour;
  EXPECT_EQ(countOf(before, found), 0);
  EXPECT_GT(countOf(before, missing), pixels / 4);
  room.settings.reset("updates");
  room.picture();
  EXPECT_EQ(countOf(draw("pending_links"), found), pixels);
  EXPECT_LT(countOf(draw("depth_segments"), vec3(0.0f)), pixels / 100);
  // Maps of 16² pixels are coarse: some texels have errors, most have none.
  const int right = countOf(draw("query_error"), vec3(0.0f));
  EXPECT_LT(right, pixels);
  EXPECT_GT(right, pixels / 4);
  room.settings.set("link_visibility", std::string("rays"));
  room.picture();
  EXPECT_NE(draw("query_error").problem.find("link_visibility=stored"), std::string::npos);
}

TEST(SurfaceShadowMaps, IsManyLightsWithLinks) {
  BouncedRoom room;
  const Image links = room.fresh();
  room.settings.set("indirect", std::string("links"));
  room.settings.set("link_visibility", std::string("stored"));
  EXPECT_TRUE(test::sameBits(room.fresh("many_lights"), links));
}

TEST(SurfaceShadowMaps, ThePictureDoesNotDependOnThreads) {
  BouncedRoom room;
  const Image expected = room.fresh();
  tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_TRUE(test::sameBits(room.fresh(), expected));
}

// The links are kept: only the direct light of the lamp is computed again.
TEST(SurfaceShadowMaps, ALampThatMovesFindsNoLinksAnew) {
  BouncedRoom room;
  room.picture(SceneChanges::all());
  const double first = room.count;
  room.edited([&](Scene& s) { s.find(room.lamp)->local.translation.x += 0.2f; });
  EXPECT_GT(room.count, 0.0);
  EXPECT_LT(room.count, first / 10.0);
  room.edited([&](Scene& s) { s.find(room.lamp)->area->radiance *= 2.0f; });
  EXPECT_EQ(room.count, 0.0);
}

TEST(SurfaceShadowMaps, DepthsAreKeptOnDisk) {
  const auto folder = std::filesystem::temp_directory_path() / "lamplighter_depths_test";
  std::filesystem::remove_all(folder);
  BouncedRoom room;
  const auto pictureWithCache = [&] {
    FrameRenderer own(makeCpuBackend());
    own.setCacheFolder(folder);
    return room.settledBy(own, SceneChanges::all(), "surface_shadow_maps");
  };
  const Image first = pictureWithCache();
  const double traced = room.count;
  EXPECT_TRUE(test::sameBits(pictureWithCache(), first));
  EXPECT_LT(room.count, 0.2 * traced);
  // A damaged file is no file.
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".depths") std::filesystem::resize_file(entry.path(), 1000);
  EXPECT_TRUE(test::sameBits(pictureWithCache(), first));
  EXPECT_EQ(room.count, traced);
  std::filesystem::remove_all(folder);
}

TEST(SurfaceShadowMaps, LightOfTheSkyBouncesToo) {
  BouncedRoom room;
  room.scene.find(room.lamp)->visible = false;
  // A room without a ceiling.
  room.scene.nodes.front().visible = false;
  test::addMesh(room.scene, test::squareMesh(4.0f, 0), vec3(0.0f, -1.5f, 0.0f));
  room.scene.sky = Sky(vec3(1.0f));
  const Image both = room.fresh();
  room.settings.set("bounces", 0);
  const Image direct = room.fresh();
  EXPECT_GT(test::meanOf(both).r, 1.01f * test::meanOf(direct).r);
  room.settings.set("bounces", 2);
  const Image reference = test::renderReference(room.scene, room.view, 256, 2);
  EXPECT_NEAR(test::meanOf(both).r / test::meanOf(reference).r, 1.0, 0.04);
}

}  // namespace
}  // namespace lamplighter
