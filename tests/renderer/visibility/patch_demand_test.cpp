// Which patches a view asks for, and a database that has only their entries.
#include "renderer/visibility/patch_demand.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/visibility/visibility_database.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/render.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr size_t kNoLimit = std::numeric_limits<size_t>::max();

struct Level {
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  VisibilityDatabase database;

  explicit Level(int boxes) : scene(test::randomBoxes(boxes, 3)) {
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    database.setScene(render, test::everythingRebuilt());
  }
  void edit(const test::Edit& edit) {
    const Scene before = scene;
    apply(scene, edit);
    const RenderSceneChanges changes = update(render, scene, compare(before, scene));
    rays->update(changes);
    database.setScene(render, changes);
  }
  PatchDemand demandOf(const View& view, size_t mostRows = kNoLimit) const {
    return findPatchDemand(database.patches(), *rays, view, mostRows);
  }
};

View viewOf(uint32_t i, int width = 320) {
  const float angle = 1.3f * static_cast<float>(i);
  return test::lookAt(vec3(6.0f * std::sin(angle), 3.0f, 6.0f * std::cos(angle)),
                      vec3(0.0f, 1.0f, 0.0f), width, width / 2);
}

size_t rowsOf(const PatchDemand& demand) {
  size_t rows = 0;
  for (const auto& object : demand.levels)
    for (const uint8_t levels : object) rows += (size_t{1} << levels) - 1;
  return rows;
}

TEST(PatchDemand, ScenesOfFewRootsAskForAll) {
  const Level level(40);
  EXPECT_TRUE(level.demandOf(viewOf(0)).isForAll);
  EXPECT_TRUE(level.demandOf(viewOf(0), 1).isForAll);
}

TEST(PatchDemand, LargeSurfacesInViewAreAskedFor) {
  const Level level(200);
  const PatchDemand demand = level.demandOf(viewOf(0));
  ASSERT_FALSE(demand.isForAll);
  // The wall opposite the camera is the second object, and only its side in view is asked for.
  ASSERT_EQ(level.database.patches(1).roots.size(), 6u);
  EXPECT_EQ(std::count_if(demand.levels[1].begin(), demand.levels[1].end(),
                          [](uint8_t levels) { return levels > 0; }),
            1);
  size_t roots = 0, asked = 0;
  for (uint32_t object = 0; object < level.database.objects(); ++object) {
    for (const int root : level.database.patches(object).roots) {
      ++roots;
      asked += demand.levels[object][static_cast<size_t>(root)] > 0;
    }
  }
  EXPECT_GT(asked, 20u);
  EXPECT_LT(asked, roots / 2);
}

TEST(PatchDemand, GrowsWithThePicture) {
  const Level level(200);
  EXPECT_LT(2 * rowsOf(level.demandOf(viewOf(0, 160))), rowsOf(level.demandOf(viewOf(0, 640))));
}

TEST(PatchDemand, FitsIntoMemoryByLeavingOutWhatIsSmall) {
  const Level level(200);
  const PatchDemand all = level.demandOf(viewOf(0)), some = level.demandOf(viewOf(0), 20);
  EXPECT_LE(rowsOf(some), 20u);
  EXPECT_GT(rowsOf(some), 5u);
  EXPECT_EQ(rowsOf(level.demandOf(viewOf(0), 0)), 0u);
  for (size_t object = 0; object < all.levels.size(); ++object)
    for (size_t patch = 0; patch < all.levels[object].size(); ++patch)
      EXPECT_TRUE(some.levels[object][patch] == 0 ||
                  some.levels[object][patch] == all.levels[object][patch]);
}

TEST(PatchDemand, AddAsksForBoth) {
  const Level level(200);
  const PatchDemand one = level.demandOf(viewOf(0)), other = level.demandOf(viewOf(2));
  PatchDemand both = one;
  both.add(other);
  for (size_t object = 0; object < both.levels.size(); ++object)
    for (size_t patch = 0; patch < both.levels[object].size(); ++patch)
      EXPECT_EQ(both.levels[object][patch],
                std::max(one.levels[object][patch], other.levels[object][patch]));
  both.add(PatchDemand());
  EXPECT_TRUE(both.isForAll);
}

// Entries do not depend on which other patches have some.
TEST(AskedPatches, HaveTheEntriesOfAWholeDatabase) {
  Level level(200);
  const std::vector<shared::Vpl> lights = test::randomVpls(50, 7);
  VisibilityDatabase whole;
  whole.setScene(level.render, test::everythingRebuilt());
  whole.setLights(level.render, lights);
  level.database.ask(level.demandOf(viewOf(0)));
  level.database.setLights(level.render, lights);
  level.database.answer(level.render, kNoLimit);
  EXPECT_EQ(level.database.unanswered(), 0u);
  EXPECT_LT(4 * level.database.tests(), whole.tests());
  size_t with = 0, without = 0;
  for (uint32_t object = 0; object < whole.objects(); ++object) {
    for (const int root : whole.patches(object).roots) {
      const auto row = level.database.row(object, root);
      if (level.database.levels(object)[static_cast<size_t>(root)] > 0) {
        ++with;
        EXPECT_TRUE(std::ranges::equal(row, whole.row(object, root)));
      } else {
        ++without;
        EXPECT_TRUE(std::ranges::all_of(
            row, [](uint8_t state) { return state == static_cast<uint8_t>(Occlusion::partial); }));
      }
    }
  }
  EXPECT_GT(with, 20u);
  EXPECT_GT(without, 200u);
}

TEST(AskedPatches, AreComputedWithinTheLimitOfTests) {
  Level level(200);
  level.database.ask(level.demandOf(viewOf(0, 640)));
  level.database.setLights(level.render, test::randomVpls(50, 7));
  const size_t all = level.database.unanswered();
  EXPECT_EQ(level.database.tests(), 0u);
  size_t calls = 0;
  for (size_t last = all; level.database.unanswered() > 0; last = level.database.unanswered()) {
    level.database.answer(level.render, 1);
    ASSERT_LT(level.database.unanswered(), last);
    ++calls;
  }
  EXPECT_GT(calls, 1u);
}

// An object that is shown again has no entries until answer(). Lights that come or go meanwhile do
// not divide its patches, whose entries are not known yet.
TEST(AskedPatches, OfANewObjectWaitForAnAnswer) {
  Level level(40);
  std::vector<shared::Vpl> lights = test::randomVpls(50, 7);
  const auto ask = [&] { level.database.ask(level.demandOf(viewOf(0))); };
  const auto showFloor = [&](bool shown) {
    const Scene before = level.scene;
    level.scene.nodes[0].visible = shown;
    const RenderSceneChanges changes =
        update(level.render, level.scene, compare(before, level.scene));
    level.rays->update(changes);
    level.database.setScene(level.render, changes);
  };
  ask();
  level.database.setLights(level.render, lights);
  showFloor(false);
  ask();
  level.database.setLights(level.render, lights);
  level.database.refreshAll(level.render);
  level.database.answer(level.render, kNoLimit);

  showFloor(true);
  ask();
  const size_t roots = level.database.patches(0).roots.size();
  ASSERT_GT(roots, 0u);
  EXPECT_EQ(level.database.unanswered(), roots);
  const size_t rows = level.database.counts().rows;
  const uint64_t tests = level.database.tests();
  lights.back().normal = vec4(0.0f);
  level.database.setLights(level.render, lights);
  for (const int root : level.database.patches(0).roots)
    EXPECT_EQ(level.database.levels(0)[static_cast<size_t>(root)], 0);
  EXPECT_LE(level.database.counts().rows, rows);
  EXPECT_EQ(level.database.tests(), tests);

  level.database.refreshAll(level.render);
  level.database.answer(level.render, kNoLimit);
  VisibilityDatabase fresh;
  fresh.setScene(level.render, test::everythingRebuilt());
  fresh.setLights(level.render, lights);
  ASSERT_EQ(level.database.counts().rows, fresh.counts().rows);
  // The slot of the light that is gone keeps its entries.
  const size_t present = lights.size() - 1;
  for (uint32_t object = 0; object < fresh.objects(); ++object) {
    for (int patch = 0; patch < static_cast<int>(fresh.patches(object).patches.size()); ++patch) {
      EXPECT_TRUE(std::ranges::equal(fresh.row(object, patch).first(present),
                                     level.database.row(object, patch).first(present)));
    }
  }
}

// Edits, movements of the camera, and answers that stop early, in any order, leave the entries of a
// new database.
bool equalsFresh(const test::EditSequence& edits) {
  Level level(120);
  const std::vector<shared::Vpl> lights = test::randomVpls(50, 7);
  level.database.setLights(level.render, lights);
  uint32_t turn = 0;
  for (const test::Edit& edit : edits) {
    level.edit(edit);
    PatchDemand demand = level.demandOf(viewOf(edit.node % 5));
    level.database.ask(demand);
    level.database.setLights(level.render, lights);
    if (++turn % 2 == 0) {
      level.database.answer(level.render, 1);
      continue;
    }
    level.database.refreshAll(level.render);
    level.database.answer(level.render, kNoLimit);
    VisibilityDatabase fresh;
    fresh.setScene(level.render, test::everythingRebuilt());
    fresh.ask(demand);
    fresh.setLights(level.render, lights);
    fresh.answer(level.render, kNoLimit);
    if (fresh.counts().rows != level.database.counts().rows) return false;
    for (uint32_t object = 0; object < fresh.objects(); ++object)
      for (size_t patch = 0; patch < fresh.patches(object).patches.size(); ++patch)
        if (!std::ranges::equal(fresh.row(object, static_cast<int>(patch)),
                                level.database.row(object, static_cast<int>(patch))))
          return false;
  }
  return true;
}

class AskedPatchesAfterEdits : public testing::TestWithParam<uint32_t> {};

TEST_P(AskedPatchesAfterEdits, HaveTheEntriesOfANewDatabase) {
  EXPECT_EQ(test::shortestFailing(test::randomEdits(9, GetParam()), equalsFresh),
            test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, AskedPatchesAfterEdits, testing::Range(1u, 7u));

}  // namespace
}  // namespace lamplighter
