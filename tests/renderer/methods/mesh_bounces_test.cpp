// many_lights with bounced light on surfaces.
#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/image/average_blocks.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

const std::string kMethod = "many_lights";

Settings meshSettings(int bounces) {
  Settings settings;
  settings.set("indirect", std::string("meshes"));
  settings.set("bounces", bounces);
  settings.set("vpls", 60);
  settings.set("updates", 60);
  settings.set("share_memory", 0);
  settings.set("antialias", 2);
  return settings;
}

struct Room {
  Scene scene;
  NodeId box = kNoNode, light = kNoNode;
  View view = test::lookAt(vec3(1.5f, 0.8f, 1.9f), vec3(0.0f, -0.4f, 0.0f), 64, 48);

  Room() {
    const int white = test::addMaterial(scene, vec3(0.8f));
    const int red = test::addMaterial(scene, vec3(0.8f, 0.2f, 0.1f), 0.0f, 0.4f);
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 4.0f), white));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), red), vec3(0.0f, -1.1f, 0.0f));
    light = test::addRectangleLight(scene, vec3(0.0f, 1.4f, 0.0f), vec2(1.0f), vec3(5.0f));
  }
};

TEST(MeshBounces, CornellBoxIsWithinThreePercentOfAnIndependentRenderer) {
  const auto references = test::sharedFolder() / "references";
  if (!std::filesystem::exists(references)) GTEST_SKIP() << "no " << references;
  for (const std::string name : {"cornell", "cornell_lightmoved"}) {
    const Scene scene = loadGltf(references / "scenes" / (name + ".gltf")).scene;
    Settings settings = meshSettings(5);
    settings.set("vpls", 300);
    settings.set("updates", 300);
    settings.set("antialias", 4);
    FrameRenderer renderer(makeCpuBackend());
    const GiOutput out = test::renderSettled(renderer, scene, SceneChanges::all(),
                                             test::viewOf(scene, 512, 384), settings);
    const Image reference = readImage(references / "refs" / (name + "_b5.exr"));
    const Image mask = readImage(references / "refs" / (name + "_mask.exr"));
    const Metrics m = compareImages(out.radiance->pixels(), reference, &mask);
    RecordProperty(name, std::to_string(m.relRmse));
    EXPECT_LT(m.relRmse, 0.03) << name;
    EXPECT_LT(std::abs(m.bias - 1.0), 0.01) << name;
  }
}

TEST(MeshBounces, DirectAndIndirectLightAddUpToTheWhole) {
  const Room room;
  const Settings settings = meshSettings(3);
  const auto picture = [&](LightPart part) {
    FrameRenderer renderer(makeCpuBackend());
    SceneChanges changes = SceneChanges::all();
    GiOutput out;
    for (int frame = 0; frame < 200 && !out.settled; ++frame) {
      FrameRenderer::Request request{room.scene, changes, room.view, kMethod, settings};
      request.part = part;
      out = renderer.render(request);
      changes = {};
    }
    EXPECT_TRUE(out.settled);
    return out.radiance->pixels();
  };
  const Image whole = picture(LightPart::all), direct = picture(LightPart::direct),
              indirect = picture(LightPart::indirect);
  EXPECT_GT(test::meanOf(indirect).g, 0.05f * test::meanOf(whole).g);
  Image sum = direct;
  for (size_t i = 0; i < sum.pixels.size(); ++i) sum.pixels[i] += indirect.pixels[i];
  // The whole picture has the light of corners and low-resolution blocks of its own.
  EXPECT_LT(compareImages(sum, whole).relRmse, 0.01);
}

TEST(MeshBounces, EditsLeaveTheBitsOfAFreshStart) {
  Room room;
  const Settings settings = meshSettings(3);
  FrameRenderer renderer(makeCpuBackend());
  const Image before =
      test::settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  const auto edited = [&](const auto& edit) {
    const Scene old = room.scene;
    edit(room.scene);
    return test::settledPicture(renderer, room.scene, compare(old, room.scene), room.view,
                                settings);
  };
  const Image moved = edited([&](Scene& s) { s.find(room.box)->local.translation.x += 0.4f; });
  EXPECT_FALSE(test::sameBits(moved, before));
  EXPECT_TRUE(
      test::sameBits(moved, test::freshPicture(makeCpuBackend(), room.scene, room.view, settings)));
  const Image dimmed = edited([&](Scene& s) { s.find(room.light)->area->radiance *= 0.7f; });
  EXPECT_TRUE(test::sameBits(
      dimmed, test::freshPicture(makeCpuBackend(), room.scene, room.view, settings)));
  const Image back = edited([&](Scene& s) {
    s.find(room.box)->local.translation.x -= 0.4f;
    s.find(room.light)->area->radiance = vec3(5.0f);
  });
  EXPECT_TRUE(test::sameBits(back, before));
}

// Shares of large pictures take several frames, between which bounced light renders the G-buffer of
// the unshifted picture. The second time bounced light is done before, so nothing interrupts them.
TEST(MeshBounces, SharesGoOnWithTheirOwnPictureAfterBouncedLight) {
  const Room room;
  const View view = test::lookAt(vec3(1.5f, 0.8f, 1.9f), vec3(0.0f, -0.4f, 0.0f), 384, 288);
  Settings settings = meshSettings(2);
  settings.set("share_memory", 64);
  settings.set("vpls", 1000);
  settings.set("updates", 100);
  settings.set("coarse_edge", 0.05f);  // so that bounced light is done last
  settings.set("gather_rays", 4096);
  settings.set("antialias", 4);
  FrameRenderer renderer(makeCpuBackend());
  const auto settled = [&](const SceneChanges& changes) {
    return test::renderSettled(renderer, room.scene, changes, view, settings).radiance->pixels();
  };
  const Image first = settled(SceneChanges::all());
  settings.set("antialias", 1);
  const Image plain = settled({});
  settings.set("antialias", 4);
  const Image again = settled({});
  EXPECT_FALSE(test::sameBits(first, plain));
  EXPECT_TRUE(test::sameBits(first, again));
}

// A floor under posts that are thinner than an element, and a panel close to a wall.
TEST(MeshBounces, LightAroundSmallObjectsIsCloseToThatOfPaths) {
  Room room;
  const int grey = test::addMaterial(room.scene, vec3(0.6f));
  for (int i = 0; i < 25; ++i)
    test::addMesh(room.scene, test::boxMesh(vec3(0.04f, 0.9f, 0.04f), grey),
                  vec3(0.45f * static_cast<float>(i % 5) - 1.5f, -1.05f,
                       0.45f * static_cast<float>(i / 5) - 1.7f));
  test::addMesh(room.scene, test::boxMesh(vec3(0.8f, 0.8f, 0.02f), grey),
                vec3(-0.8f, 0.2f, -1.95f));
  const auto indirect = [&](const std::string& method, const Settings& settings) {
    FrameRenderer renderer(makeCpuBackend());
    SceneChanges changes = SceneChanges::all();
    GiOutput out;
    for (int frame = 0; frame < 1000 && !out.settled; ++frame) {
      FrameRenderer::Request request{room.scene, changes, room.view, method, settings};
      request.part = LightPart::indirect;
      out = renderer.render(request);
      changes = {};
    }
    EXPECT_TRUE(out.settled);
    return out.radiance->pixels();
  };
  Settings paths;
  paths.set("bounces", 2);
  paths.set("spp", 400);
  const Image reference = averageBlocks(indirect("reference", paths), 4);
  const Image shown = averageBlocks(indirect(kMethod, meshSettings(2)), 4);
  const Metrics m = compareImages(shown, reference);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 0.05);
  EXPECT_NEAR(m.bias, 1.0, 0.02);
}

TEST(MeshBounces, RefinementWaitsForLightOnSurfaces) {
  Room room;
  Settings settings = meshSettings(3);
  settings.set("antialias", 4);
  FrameRenderer renderer(makeCpuBackend());
  const auto settle = [&](SceneChanges changes) {
    for (bool settled = false; !settled; changes = {}) {
      FrameRenderer::Request request{room.scene, changes, room.view, kMethod, settings};
      request.budget.refineUpdates = 64;
      const GiOutput out = renderer.render(request);
      settled = out.settled;
      EXPECT_FALSE(out.refined);
      if (!settled) {
        EXPECT_EQ(out.stats.refineUpdates, 0);
      }
    }
    FrameRenderer::Request request{room.scene, {}, room.view, kMethod, settings};
    request.budget.refineUpdates = 64;
    EXPECT_GT(renderer.render(request).stats.refineUpdates, 0);
  };
  settle(SceneChanges::all());
  Scene before = room.scene;
  room.scene.find(room.box)->local.translation.x += 0.4f;
  settle(compare(before, room.scene));
  before = room.scene;
  room.scene.find(room.light)->area->radiance *= 0.5f;
  settle(compare(before, room.scene));
}

TEST(MeshBounces, BouncedLightIsCurrentInTheFrameOfAnEdit) {
  Room room;
  Settings settings = meshSettings(3);
  settings.set("speculars", false);  // mirrors wait until nothing moves
  FrameRenderer renderer(makeCpuBackend());
  test::settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  const Scene old = room.scene;
  room.scene.find(room.light)->local.translation += vec3(1.2f, 0.0f, 0.6f);
  settings.set("antialias", 1);
  const auto shown = [&](FrameRenderer& by, const SceneChanges& changes) {
    FrameRenderer::Request request{room.scene, changes, room.view, kMethod, settings};
    request.part = LightPart::indirect;
    return by.render(request).radiance->pixels();
  };
  const Image now = shown(renderer, compare(old, room.scene));
  // A fresh start gets there in several frames.
  FrameRenderer other(makeCpuBackend());
  Image fresh = shown(other, SceneChanges::all());
  for (int i = 0; i < 40; ++i) fresh = shown(other, {});
  // All light is current but for the choice of records, which waits until nothing moves.
  const Metrics m = compareImages(now, fresh);
  RecordProperty("relRmse", std::to_string(m.relRmse));
  EXPECT_LT(m.relRmse, 1e-4);
  EXPECT_TRUE(test::sameBits(shown(renderer, {}), fresh));
}

}  // namespace
}  // namespace lamplighter
