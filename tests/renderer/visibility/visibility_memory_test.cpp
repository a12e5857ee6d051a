// The memory limit of the visibility database: patches are divided less, and no entry becomes
// wrong.
#include <iostream>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/visibility/visibility_database.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr size_t kMebibyte = size_t{1} << 20;

struct Room {
  RenderScene scene = test::renderSceneOf(test::loadAsset("pillar_room"));
  // About a thousand, because paths end at random.
  std::vector<shared::Vpl> lights = test::lightsOf(scene, 1000);
  void fill(VisibilityDatabase& database, size_t count) const {
    database.setLights(scene, std::span(lights).first(count));
  }
};

// Counts the differing entries of leaves. Those of `coarse` must be partial.
size_t coarser(const VisibilityDatabase& coarse, const VisibilityDatabase& fine) {
  size_t count = 0;
  for (uint32_t object = 0; object < fine.objects(); ++object) {
    for (size_t p = 0; p < fine.patches(object).patches.size(); ++p) {
      if (!fine.patches(object).patches[p].isLeaf()) continue;
      const auto a = coarse.row(object, static_cast<int>(p)),
                 b = fine.row(object, static_cast<int>(p));
      for (size_t slot = 0; slot < a.size(); ++slot) {
        if (a[slot] == b[slot]) continue;
        EXPECT_EQ(a[slot], static_cast<uint8_t>(Occlusion::partial));
        ++count;
      }
    }
  }
  return count;
}

TEST(VisibilityMemory, LessIsCoarserAndNeverWrong) {
  const Room room;
  VisibilityDatabase fine;
  fine.setScene(room.scene, test::everythingRebuilt());
  room.fill(fine, room.lights.size());
  ASSERT_GT(fine.bytes(), kMebibyte / 2);
  size_t before = 0;
  for (const size_t most : {kMebibyte / 2, kMebibyte / 4, kMebibyte / 8}) {
    VisibilityDatabase coarse;
    coarse.limitMemory(most);
    coarse.setScene(room.scene, test::everythingRebuilt());
    room.fill(coarse, room.lights.size());
    EXPECT_LE(coarse.bytes(), most);
    const size_t now = coarser(coarse, fine);
    EXPECT_GT(now, before);
    before = now;
  }
}

// With more lights patches are divided less, with fewer lights or more memory they are divided
// further.
TEST(VisibilityMemory, FollowsTheNumberOfLightsAndTheLimit) {
  const Room room;
  const auto fresh = [&](size_t most, size_t lights) {
    VisibilityDatabase database;
    database.limitMemory(most);
    database.setScene(room.scene, test::everythingRebuilt());
    room.fill(database, lights);
    return database;
  };
  const size_t all = room.lights.size();
  VisibilityDatabase kept = fresh(kMebibyte / 4, 100);
  const size_t divided = kept.counts().divided;
  room.fill(kept, all);
  EXPECT_LT(kept.counts().divided, divided);
  EXPECT_LE(kept.bytes(), kMebibyte / 4);
  EXPECT_EQ(coarser(kept, fresh(kMebibyte / 4, all)), 0u);
  room.fill(kept, 100);
  EXPECT_EQ(kept.counts().divided, divided);
  EXPECT_EQ(coarser(kept, fresh(kMebibyte / 4, 100)), 0u);
  kept.limitMemory(16 * kMebibyte);
  room.fill(kept, all);
  const VisibilityDatabase plenty = fresh(16 * kMebibyte, all);
  EXPECT_EQ(kept.counts().divided, plenty.counts().divided);
  EXPECT_EQ(coarser(kept, plenty), 0u);
}

// Patches that are asked for before there are lights.
TEST(VisibilityMemory, LightsMayComeLaterAndGo) {
  const Room room;
  VisibilityDatabase fresh, kept;
  for (VisibilityDatabase* database : {&fresh, &kept})
    database->setScene(room.scene, test::everythingRebuilt());
  PatchDemand none{false, {}}, demand{false, {}};
  for (const ObjectPatches& patches : kept.patches()) {
    none.levels.emplace_back(patches.patches.size(), uint8_t{0});
    auto& levels = demand.levels.emplace_back(none.levels.back());
    for (const int root : patches.roots) levels[static_cast<size_t>(root)] = 5;
  }
  kept.ask(none);
  kept.ask(demand);
  kept.answer(room.scene, std::numeric_limits<uint64_t>::max());
  room.fill(fresh, 200);
  fresh.ask(demand);
  fresh.answer(room.scene, std::numeric_limits<uint64_t>::max());
  for (const size_t lights : {0, 200, 0, 200}) {
    room.fill(kept, lights);
    if (lights == 0) continue;
    EXPECT_EQ(coarser(kept, fresh), 0u);
    EXPECT_EQ(coarser(fresh, kept), 0u);
  }
}

TEST(VisibilityMemory, ThePictureStaysTheSame) {
  const test::AssetRoom room("pillar_room", 96, 60);
  Settings settings;
  settings.set("indirect", std::string("samples"));
  settings.set("vpls", 2000);
  settings.set("bounces", 1);
  settings.set("updates", 4000);
  settings.set("antialias", 1);
  const auto render = [&](int mebibytes) {
    settings.set("visibility_memory", mebibytes);
    FrameRenderer renderer(makeCpuBackend());
    return test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  };
  const GiOutput plenty = render(512), little = render(1);
  EXPECT_GT(plenty.stats.of("visibility_bytes"), kMebibyte);
  EXPECT_LE(little.stats.of("visibility_bytes"), kMebibyte);
  const double error = compareImages(little.radiance->pixels(), plenty.radiance->pixels()).relRmse;
  EXPECT_LT(error, 0.005);
  std::cout << "relRMSE " << 100.0 * error << "%\n";
}

// With more light samples than even the roots have memory for: the picture is that of `naive` until
// the limit is raised.
TEST(VisibilityMemory, IfNothingFitsThePictureIsThatOfNaive) {
  test::AssetRoom room("pillar_room", 64, 40);
  const auto box = test::boxMesh(vec3(0.05f));
  for (int i = 0; i < 60; ++i)
    test::addMesh(room.scene, box,
                  vec3(0.1f * static_cast<float>(i % 40), 0.1f, 0.1f * static_cast<float>(i / 40)));
  Settings settings;
  settings.set("indirect", std::string("samples"));
  settings.set("vpls", 4000);
  settings.set("map_resolution", 16);
  settings.set("settled_map_scale", 1);
  settings.set("bounces", 1);
  settings.set("updates", 10000);
  settings.set("antialias", 1);
  settings.set("share_memory", 0);  // compares the sums of pixels
  settings.set("visibility_memory", 1);
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput without =
      test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  EXPECT_GT(without.stats.of("visibility_bytes_needed"), kMebibyte);
  EXPECT_EQ(without.stats.of("visibility_bytes"), 0u);
  settings.set("visibility_memory", 512);
  const GiOutput with = test::renderSettled(renderer, room.scene, {}, room.view, settings);
  EXPECT_EQ(with.stats.of("visibility_bytes_needed"), 0u);
  EXPECT_GT(with.stats.of("visibility_bytes"), kMebibyte);
  settings.set("technique", std::string("naive"));
  FrameRenderer other(makeCpuBackend());
  const GiOutput naive =
      test::renderSettled(other, room.scene, SceneChanges::all(), room.view, settings);
  EXPECT_TRUE(test::sameBits(without.radiance->pixels(), naive.radiance->pixels()));
  EXPECT_LT(compareImages(with.radiance->pixels(), naive.radiance->pixels()).relRmse, 0.03);
}

}  // namespace
}  // namespace lamplighter
