// Merged passes (paper 1, section 4.3.5) of the gl backend: each pixel gets each of its lights
// once, with at most as many draw calls as object by object.
#include <set>

#include "renderer/backends/gl/gl_backend.h"
#include "renderer/backends/gl/many_lights/light_lists.h"
#include "renderer/image/metrics.h"
#include "renderer/light_maps/pass_merging.h"
#include "shaders/shared/patches.h"
#include "tests/renderer/gl/gl_test.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// The same lights are added in another order, so the last bits of float sums differ: each of a few
// hundred additions rounds by at most 2⁻²⁴, up or down.
constexpr double kRounding = 1e-6;

Settings settingsOf(const std::string& technique, int vpls, int lightsPerPass, bool merge) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("updates", vpls);
  s.set("antialias", 1);
  s.set("block", std::string("1"));
  s.set("lights_per_pass", lightsPerPass);
  s.set("merge_passes", merge);
  return s;
}

GiOutput rendered(FrameRenderer& renderer, const Scene& scene, const SceneChanges& changes,
                  const Settings& settings) {
  return test::renderSettled(renderer, scene, changes, test::viewOf(scene, 160, 100), settings);
}

GiOutput rendered(std::unique_ptr<Backend> backend, const Scene& scene, const Settings& settings) {
  FrameRenderer renderer(std::move(backend));
  GiOutput out = rendered(renderer, scene, SceneChanges::all(), settings);
  out.radiance = std::make_shared<HostImage>(out.radiance->pixels());  // outlives the backend
  return out;
}

using MergedGlPasses = test::GlTest;

TEST_F(MergedGlPasses, GiveTheSamePictureWithFewerDrawCalls) {
  for (const char* name : {"pillar_room", "table_room"}) {
    const Scene scene = test::loadAsset(name);
    for (const char* technique : {"visibility", "light_maps"}) {
      const GiOutput listed =
          rendered(makeGlBackend(), scene, settingsOf(technique, 150, 6, false));
      EXPECT_EQ(listed.stats.of("merged_passes"), 0);
      for (const int most : {1, 6, 1024}) {
        SCOPED_TRACE(std::string(name) + " " + technique + " " + std::to_string(most));
        const GiOutput merged =
            rendered(makeGlBackend(), scene, settingsOf(technique, 150, most, true));
        EXPECT_LT(compareImages(merged.radiance->pixels(), listed.radiance->pixels()).relRmse,
                  kRounding);
        EXPECT_GT(merged.stats.of("merged_passes"), 0);
        // If one draw call takes all lights of an object, there is little to merge.
        if (most <= 6) {
          EXPECT_GT(merged.stats.of("passes_saved"), merged.stats.of("merged_passes"));
        }
      }
    }
  }
}

TEST_F(MergedGlPasses, WorkForSeveralLightKindsTextureArraysAndBlocks) {
  Scene scene = test::loadAsset("pillar_room");
  scene.sky = vec3(0.3f, 0.4f, 0.5f);
  Image pictures[2];
  for (const bool merge : {false, true}) {
    Settings settings = settingsOf("light_maps", 2500, 64, merge);
    settings.set("map_resolution", 16);
    pictures[merge] = rendered(makeGlBackend(), scene, settings).radiance->pixels();
  }
  EXPECT_LT(compareImages(pictures[1], pictures[0]).relRmse, kRounding);
}

TEST_F(MergedGlPasses, SwitchingThemEqualsAFreshRender) {
  Scene scene = test::loadAsset("pillar_room");
  FrameRenderer renderer(makeGlBackend());
  rendered(renderer, scene, SceneChanges::all(), settingsOf("light_maps", 100, 6, false));
  const Scene before = scene;
  for (Node& node : scene.nodes)
    if (node.name == "mover") node.local.translation.x += 0.5f;
  SceneChanges changes = compare(before, scene);
  for (const bool merge : {true, false, true}) {
    const Settings settings = settingsOf("light_maps", 100, 6, merge);
    const GiOutput switched = rendered(renderer, scene, changes, settings);
    changes = {};
    const GiOutput fresh = rendered(makeGlBackend(), scene, settings);
    EXPECT_TRUE(test::sameBits(switched.radiance->pixels(), fresh.radiance->pixels())) << merge;
    EXPECT_EQ(switched.stats.of("merged_passes"), fresh.stats.of("merged_passes"));
    EXPECT_EQ(switched.stats.of("merged_passes") > 0, merge);
  }
  // `naive` and the cpu backend have no light lists, so there is nothing to merge.
  EXPECT_EQ(
      rendered(renderer, scene, {}, settingsOf("naive", 100, 6, true)).stats.of("merged_passes"),
      0);
  EXPECT_EQ(rendered(makeCpuBackend(), scene, settingsOf("light_maps", 100, 6, true))
                .stats.of("merged_passes"),
            0);
}

// The lists contain the same entries as before, sorted by pass, and no pass takes more lights than
// allowed.
TEST(MergedLists, ContainEachLightOnceInFullPasses) {
  const Scene scene = test::loadAsset("table_room");
  const RenderScene render = test::renderSceneOf(scene);
  std::vector<shared::Vpl> vpls = test::lightsOf(render, {90, 0.5f, 1, 1});
  for (size_t i = 0; i < vpls.size(); ++i) vpls[i].slot = static_cast<int>(i);
  VisibilityDatabase database;
  database.setScene(render, test::everythingRebuilt());
  database.setLights(render, vpls);
  const PatchLights patches(database, nullptr, true);
  std::vector<gl::SeenObject> objects;
  std::vector<uint32_t> numbers;
  uint32_t nodes = 0;
  for (uint32_t o = 0; o < render.objects.size(); ++o) {
    objects.push_back({o, nodes, false});
    numbers.push_back(o);
    nodes += static_cast<uint32_t>(patches.patches(o).patches.size());
  }
  const gl::LightGroup groups[] = {{0, 40}, {40, vpls.size() - 40}};
  gl::LightLists plain, merged;
  constexpr int kMost = 6;
  for (gl::LightLists* lists : {&plain, &merged})
    lists->make(patches, objects, nodes, Frustum(), vpls, groups);
  merged.mergePasses(kMost);

  int drawn = 0, byObject = 0;
  const size_t stride = gl::LightLists::places(nodes);
  for (size_t g = 0; g < 2; ++g) {
    std::vector<std::set<uint32_t>> lights(static_cast<size_t>(merged.passes()[g]));
    drawn += merged.passes()[g];
    for (size_t o = 0; o < objects.size(); ++o) {
      std::set<uint32_t> needed;
      const size_t end = o + 1 < objects.size() ? objects[o + 1].firstNode : nodes;
      for (size_t place = 1 + 2 * objects[o].firstNode; place < 1 + 2 * end; ++place) {
        const glm::uvec2 range = plain.ranges()[g * stride + place];
        ASSERT_EQ(merged.ranges()[g * stride + place], range);
        const size_t first = range.x + (range.y & 65535u), count = range.y >> 16;
        std::vector<uint32_t> was, is;
        uint32_t before = 0;
        for (size_t i = first; i < first + count; ++i) {
          was.push_back(plain.entries()[i]);
          const uint32_t entry = merged.entries()[i];
          const uint32_t pass = entry / shared::kPassUnit;
          is.push_back(entry % shared::kPassUnit);
          ASSERT_LT(pass, lights.size());
          ASSERT_GE(pass, before);
          before = pass;
          lights[pass].insert(is.back());
          needed.insert(is.back());
        }
        std::sort(is.begin(), is.end());
        ASSERT_EQ(is, was);
        // Entries of lights that need no shadow map are unchanged.
        for (size_t i = range.x; i < first; ++i) ASSERT_EQ(merged.entries()[i], plain.entries()[i]);
      }
      byObject += (static_cast<int>(needed.size()) + kMost - 1) / kMost;
    }
    for (const auto& pass : lights) {
      EXPECT_GE(pass.size(), 1u);
      EXPECT_LE(pass.size(), static_cast<size_t>(kMost));
    }
  }
  EXPECT_EQ(drawn + merged.passesSaved(), byObject);
  EXPECT_GT(merged.passesSaved(), 0);
}

}  // namespace
}  // namespace lamplighter
