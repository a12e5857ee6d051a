// Fine shadow maps, which replace coarse ones when the picture has settled otherwise, on the cpu
// backend.
#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/frame/frame.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

using test::sameBits;

constexpr int kCoarse = 16, kScale = 4;

// The pillar room, whose mover is complex, with maps of 16² texels that are replaced by 64².
struct FineMaps : testing::Test, test::AssetRoom {
  Settings settings;
  FrameRenderer renderer{makeCpuBackend()};

  FineMaps() : AssetRoom("pillar_room", 93, 61) {
    settings.set("share_memory", 0);
    settings.set("vpls", 60);
    settings.set("indirect", std::string("samples"));
    settings.set("updates", 20);
    settings.set("antialias", 1);
    settings.set("map_resolution", kCoarse);
    settings.set("settled_map_scale", kScale);
  }
  GiOutput step(const SceneChanges& changes = {}) {
    return renderer.render({scene, changes, view, "many_lights", settings});
  }
  GiOutput settle(const SceneChanges& changes = {}) {
    return test::renderSettled(renderer, scene, changes, view, settings);
  }
  Node& nodeOf(const std::string& name) {
    return *std::find_if(scene.nodes.begin(), scene.nodes.end(),
                         [&](const Node& node) { return node.name == name; });
  }
  SceneChanges move(const std::string& name, const vec3& by) {
    const Scene before = scene;
    nodeOf(name).local.translation += by;
    return compare(before, scene);
  }
  Image freshPicture(int resolution, int scale) const {
    Settings other = settings;
    other.set("map_resolution", resolution);
    other.set("settled_map_scale", scale);
    return test::freshPicture(makeCpuBackend(), scene, view, other);
  }
  // The number of stored maps that are fine.
  uint64_t fine() {
    const ManyLightsCounts counts = test::lightCounts(renderer.backend());
    const uint64_t coarse = 4 * kCoarse * kCoarse;
    return (counts.mapBytes - counts.mapsHeld * coarse) / (coarse * (kScale * kScale - 1));
  }
};

TEST_F(FineMaps, ASettledPictureUsesFineMaps) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    for (const char* block : {"1", "4"}) {
      SCOPED_TRACE(std::string(technique) + ", blocks of " + block);
      settings.set("technique", std::string(technique));
      settings.set("block", std::string(block));
      const Image picture = settle(SceneChanges::all()).radiance->pixels();
      EXPECT_EQ(fine(), test::lightCounts(renderer.backend()).mapsHeld);
      EXPECT_TRUE(sameBits(picture, freshPicture(kCoarse * kScale, 1)));
      EXPECT_FALSE(sameBits(picture, freshPicture(kCoarse, 1)));
    }
  }
}

// Each frame renders as many fine maps as the budget allows, and none before all other work is
// done.
TEST_F(FineMaps, AreRenderedLastAndWithinTheBudget) {
  GiOutput out = step(SceneChanges::all());
  while (out.stats.of("vpls_pending") > 0) {
    EXPECT_EQ(fine(), 0u);
    EXPECT_FALSE(out.settled);
    out = step();
  }
  int left = static_cast<int>(out.stats.of("maps_to_sharpen"));
  EXPECT_EQ(left, out.stats.of("maps_held"));
  while (left > 0) {
    EXPECT_FALSE(out.settled);
    const int predicted = out.stats.framesUntilSettled;
    EXPECT_EQ(predicted, (left + 9) / 10);
    out = step();
    EXPECT_EQ(out.stats.of("maps_sharpened"), std::min(left, 10));
    EXPECT_EQ(out.stats.of("maps_to_sharpen"), left - out.stats.of("maps_sharpened"));
    left = static_cast<int>(out.stats.of("maps_to_sharpen"));
  }
  EXPECT_TRUE(out.settled);
  const uint64_t rendered = test::lightCounts(renderer.backend()).shadowMaps;
  const auto picture = out.radiance;
  EXPECT_EQ(step().radiance, picture);
  EXPECT_EQ(test::lightCounts(renderer.backend()).shadowMaps, rendered);

  // Under `max_rays`, a fine map counts its number of rays.
  settings.set("max_rays", 3 * kCoarse * kScale * kCoarse * kScale);
  out = step(move("mover", vec3(0.2f, 0.0f, 0.0f)));
  while (out.stats.of("maps_sharpened") == 0) out = step();
  EXPECT_EQ(out.stats.of("maps_sharpened"), std::min(3.0, 3 + out.stats.of("maps_to_sharpen")));
}

// The maps that a moved object affects are coarse in the next frame, the others stay fine. A moved
// light affects all of its own maps.
TEST_F(FineMaps, MapsAffectedByAnEditBecomeCoarse) {
  settle(SceneChanges::all());
  const uint64_t held = test::lightCounts(renderer.backend()).mapsHeld;
  ASSERT_EQ(fine(), held);
  GiOutput out = step(move("mover", vec3(0.1f, 0.0f, 0.0f)));
  EXPECT_GT(out.stats.of("maps_rendered"), 0);
  EXPECT_EQ(out.stats.of("maps_sharpened"), 0);
  EXPECT_EQ(held - fine(), static_cast<uint64_t>(out.stats.of("maps_rendered")));
  settle();
  const uint64_t now = test::lightCounts(renderer.backend()).mapsHeld;
  EXPECT_EQ(fine(), now);
  settings.set("updates", 60);
  out = step(move("ceiling light", vec3(0.3f, 0.0f, 0.0f)));
  EXPECT_LT(fine(), now / 2);
}

// The camera turns away, an edit follows while maps are replaced, and the camera turns back: the
// picture equals a fresh render.
TEST_F(FineMaps, AfterEditsThePictureEqualsAFreshRender) {
  for (const char* technique : {"naive", "light_maps"}) {
    SCOPED_TRACE(technique);
    settings.set("technique", std::string(technique));
    const Image first = settle(SceneChanges::all()).radiance->pixels();
    const View front = view;
    for (int i = 0; i < 12; ++i) {
      if (i % 3 == 1) view.eye.x += 0.2f;
      step(move(i % 4 == 3 ? "ceiling light" : "mover", vec3(i < 6 ? 0.1f : -0.1f, 0.0f, 0.0f)));
      for (int frame = 0; frame < i; ++frame) step();
    }
    EXPECT_TRUE(sameBits(settle().radiance->pixels(), freshPicture(kCoarse, kScale)));
    view = front;
    nodeOf("mover").local.translation.x += 0.1f;
    const Image edited = settle(SceneChanges::all()).radiance->pixels();
    EXPECT_FALSE(sameBits(first, edited));
    EXPECT_TRUE(sameBits(edited, freshPicture(kCoarse, kScale)));
  }
}

// The maps are as fine as possible if all of them must fit into the memory.
TEST_F(FineMaps, KeepWithinTheMemory) {
  settings.set("map_memory", 1);
  for (const auto& [vpls, scale] : {std::pair(20, 4), {120, 2}, {600, 1}}) {
    SCOPED_TRACE(vpls);
    settings.set("vpls", vpls);
    GiOutput out = step(SceneChanges::all());
    while (!out.settled) {
      EXPECT_LE(test::lightCounts(renderer.backend()).mapBytes, uint64_t{1} << 20);
      out = step();
    }
    const ManyLightsCounts counts = test::lightCounts(renderer.backend());
    EXPECT_EQ(counts.mapBytes,
              counts.mapsHeld * 4u * static_cast<uint64_t>(kCoarse * kCoarse * scale * scale));
  }
}

}  // namespace
}  // namespace lamplighter
