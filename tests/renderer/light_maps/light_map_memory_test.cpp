// The memory limit of light maps. It is never exceeded, and the result does not depend on earlier
// edits.
#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/light_maps/light_maps.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

Scene litBoxes(int count = 14) {
  Scene scene = test::randomBoxes(count, 5);
  test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12, 9, 5));
  return scene;
}

// Light maps of a scene under a memory limit, updated incrementally.
struct Kept {
  RenderScene scene;
  VisibilityDatabase visibility;
  LightMaps maps;
  LightMaps::Options options{0.02f, 0.5f};

  explicit Kept(uint64_t mostBytes = UINT64_MAX) { options.mostBytes = mostBytes; }
  void update(const Scene& from, const SceneChanges& changes, int count = 40,
              bool mayBeFiner = true) {
    visibility.setScene(scene, lamplighter::update(scene, from, changes));
    const std::vector<shared::Vpl> lights = test::lightsOf(scene, {count, 0.5f, 1, 1});
    visibility.setLights(scene, lights);
    visibility.refreshAll(scene);
    maps.update(scene, visibility, lights, options, nullptr, mayBeFiner);
    visibility.clearChanged();
  }
};

TEST(LightMapMemory, IsNotExceeded) {
  const Scene scene = litBoxes();
  Kept plenty;
  plenty.update(scene, SceneChanges::all());
  EXPECT_EQ(plenty.maps.texel(), plenty.options.texel);
  const uint64_t all = plenty.maps.bytes();
  float last = plenty.options.texel;
  for (const uint64_t part : {1u, 2u, 5u, 9u}) {
    Kept little(all / part - (part == 1 ? 0 : 1));
    little.update(scene, SceneChanges::all());
    EXPECT_LE(little.maps.bytes(), little.options.mostBytes);
    EXPECT_GT(little.maps.bytes(), little.options.mostBytes / 5) << "most of the memory is unused";
    EXPECT_TRUE(part == 1 ? little.maps.texel() == last : little.maps.texel() > last) << part;
    last = little.maps.texel();
  }
  Kept none(1000);
  none.update(scene, SceneChanges::all());
  EXPECT_EQ(none.maps.texel(), 0.0f);
  EXPECT_EQ(none.maps.bytes(), 0u);
  for (uint32_t object = 0; object < none.scene.objects.size(); ++object)
    for (size_t p = 0; p < none.visibility.patches(object).patches.size(); ++p)
      EXPECT_EQ(none.maps.tile(object, static_cast<int>(p)), nullptr);
}

// A new object leaves less memory for each light map; removing it gives the memory back.
TEST(LightMapMemory, IsSharedByTheCurrentObjects) {
  const Scene before = litBoxes();
  Kept plenty;
  plenty.update(before, SceneChanges::all());
  const uint64_t room = plenty.maps.bytes() + 1000;
  Kept kept(room);
  kept.update(before, SceneChanges::all());
  const uint64_t hash = kept.maps.hash();
  EXPECT_EQ(hash, plenty.maps.hash());
  Scene after = before;
  test::addMesh(after, test::boxMesh(vec3(1.0f)), vec3(1.0f, 3.0f, 1.0f));
  kept.update(after, compare(before, after));
  EXPECT_GT(kept.maps.texel(), kept.options.texel);
  EXPECT_LE(kept.maps.bytes(), room);
  Kept fresh(room);
  fresh.update(after, SceneChanges::all());
  EXPECT_EQ(kept.maps.hash(), fresh.maps.hash());
  kept.update(before, compare(after, before));
  EXPECT_EQ(kept.maps.texel(), kept.options.texel);
  EXPECT_EQ(kept.maps.hash(), hash);
}

// Another texel size requires all maps to be rendered again. Coarser texels are applied at once if
// memory requires it, finer texels only when allowed.
TEST(LightMapMemory, TexelsBecomeFinerOnlyWhenAllowed) {
  const Scene before = litBoxes();
  Kept kept;
  kept.update(before, SceneChanges::all());
  kept.options.mostBytes = kept.maps.bytes() + 1000;
  kept.update(before, {});
  const float texel = kept.maps.texel();
  Scene after = before;
  test::addMesh(after, test::boxMesh(vec3(1.0f)), vec3(1.0f, 3.0f, 1.0f));
  kept.update(after, compare(before, after), 40, false);
  EXPECT_GT(kept.maps.texel(), texel);
  EXPECT_FALSE(kept.maps.couldBeFiner());
  kept.update(before, compare(after, before), 40, false);
  EXPECT_GT(kept.maps.texel(), texel);
  EXPECT_TRUE(kept.maps.couldBeFiner());
  kept.update(before, {}, 40, true);
  EXPECT_EQ(kept.maps.texel(), texel);
  EXPECT_FALSE(kept.maps.couldBeFiner());
  Kept fresh;
  fresh.update(before, SceneChanges::all());
  EXPECT_EQ(kept.maps.hash(), fresh.maps.hash());
}

// Memory of removed lights is released.
TEST(LightMapMemory, CountsOnlyCurrentLights) {
  const Scene scene = litBoxes();
  Kept kept, fresh;
  kept.update(scene, SceneChanges::all(), 900);
  for (int i = 0; i < 2; ++i) kept.update(scene, {}, 40);
  fresh.update(scene, SceneChanges::all(), 40);
  EXPECT_EQ(kept.maps.bytes(), fresh.maps.bytes());
  EXPECT_EQ(kept.maps.hash(), fresh.maps.hash());
}

TEST(LightMapMemory, ThePictureStaysNearlyTheSame) {
  const test::AssetRoom room("pillar_room", 96, 60);
  Settings settings;
  settings.set("vpls", 200);
  settings.set("bounces", 1);
  settings.set("updates", 400);
  settings.set("antialias", 1);
  settings.set("indirect", std::string("samples"));
  settings.set("light_map_texel", 0.02f);
  const auto render = [&](int mebibytes) {
    settings.set("light_map_memory", mebibytes);
    FrameRenderer renderer(makeCpuBackend());
    return test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  };
  const GiOutput plenty = render(512), little = render(1);
  EXPECT_GT(plenty.stats.of("light_map_bytes"), uint64_t{2} << 20);
  EXPECT_LE(little.stats.of("light_map_bytes"), uint64_t{1} << 20);
  EXPECT_GT(little.stats.of("light_map_texel"), plenty.stats.of("light_map_texel"));
  const double error = compareImages(little.radiance->pixels(), plenty.radiance->pixels()).relRmse;
  RecordProperty("relRmse", std::to_string(error));
  EXPECT_LT(error, 0.01);
}

// With a camera at rest: without memory for light maps pixels sum all lights; with memory light
// maps are used again.
TEST(LightMapMemory, ThePictureFollowsTheMemoryLimit) {
  // Larger boxes: more tiles, but few enough roots for all of them to have entries.
  Scene scene = litBoxes(80);
  for (Node& node : scene.nodes) {
    node.local.translation *= 3.0f;
    node.local.scale *= 3.0f;
  }
  const RenderScene render = test::renderSceneOf(scene);
  const View view = viewOfBounds(render.bounds, 192, 128);
  Settings settings;
  settings.set("vpls", 60);
  settings.set("antialias", 1);
  settings.set("indirect", std::string("samples"));
  settings.set("light_map_texel", 0.02f);
  FrameRenderer kept(makeCpuBackend());
  std::vector<float> texels;
  SceneChanges changes = SceneChanges::all();
  for (const int mebibytes : {512, 1, 4, 1, 512}) {
    settings.set("light_map_memory", mebibytes);
    const GiOutput out = test::renderSettled(kept, scene, changes, view, settings);
    FrameRenderer freshRenderer(makeCpuBackend());
    const GiOutput fresh =
        test::renderSettled(freshRenderer, scene, SceneChanges::all(), view, settings);
    EXPECT_EQ(out.stats.of("light_map_texel"), fresh.stats.of("light_map_texel"));
    EXPECT_TRUE(test::sameBits(out.radiance->pixels(), fresh.radiance->pixels())) << mebibytes;
    texels.push_back(static_cast<float>(out.stats.of("light_map_texel")));
    changes = {};
  }
  EXPECT_EQ(texels[0], 0.02f);
  EXPECT_EQ(texels[1], 0.0f);
  EXPECT_GT(texels[2], 0.02f);
}

}  // namespace
}  // namespace lamplighter
