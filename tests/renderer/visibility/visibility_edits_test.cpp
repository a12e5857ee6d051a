// Incremental updates of the visibility database against a new database: all entries must be equal,
// otherwise the picture would depend on earlier edits.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/visibility/visibility_database.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// Counts the differing entries of the first `slots` slots.
int differences(const VisibilityDatabase& a, const VisibilityDatabase& b,
                size_t slots = std::numeric_limits<size_t>::max()) {
  int count = 0;
  for (uint32_t object = 0; object < a.objects(); ++object) {
    for (size_t p = 0; p < a.patches(object).patches.size(); ++p) {
      const auto ra = a.row(object, static_cast<int>(p)), rb = b.row(object, static_cast<int>(p));
      for (size_t i = 0; i < std::min(ra.size(), slots); ++i) count += ra[i] != rb[i];
    }
  }
  return count;
}

constexpr size_t kLittleMemory = 150000;  // bytes

// Applies edits while the lights stay unchanged, and compares all entries with those of a new
// database, under a memory limit of `mostBytes`.
bool equalsFreshAfterEdits(const test::EditSequence& edits, size_t mostBytes) {
  Scene level = test::loadAsset("default");
  RenderScene scene = test::renderSceneOf(level);
  const std::vector<shared::Vpl> lights = test::lightsOf(scene, 150);
  VisibilityDatabase kept;
  kept.limitMemory(mostBytes);
  kept.setScene(scene, test::everythingRebuilt());
  kept.setLights(scene, lights);
  for (const test::Edit& edit : edits) {
    const Scene before = level;
    apply(level, edit);
    kept.setScene(scene, update(scene, level, compare(before, level)));
    kept.refreshAll(scene);
    VisibilityDatabase fresh;
    fresh.limitMemory(mostBytes);
    fresh.setScene(scene, test::everythingRebuilt());
    fresh.setLights(scene, lights);
    if (kept.objects() != fresh.objects() || differences(kept, fresh) != 0) return false;
    if (kept.counts().divided != fresh.counts().divided) return false;
    if (kept.bytes() > mostBytes) return false;
  }
  return true;
}

class EditsOfALevel : public testing::TestWithParam<uint32_t> {};

TEST_P(EditsOfALevel, GiveTheEntriesOfANewDatabase) {
  const auto check = [](const test::EditSequence& edits) {
    return equalsFreshAfterEdits(edits, std::numeric_limits<size_t>::max());
  };
  EXPECT_EQ(test::shortestFailing(test::randomEdits(12, GetParam()), check), test::EditSequence());
  EXPECT_EQ(test::shortestFailing(test::randomStructureEdits(8, GetParam()), check),
            test::EditSequence());
}

// Adding and removing objects changes how far all others may be divided.
TEST_P(EditsOfALevel, GiveTheEntriesOfANewDatabaseWithLittleMemory) {
  const auto check = [](const test::EditSequence& edits) {
    return equalsFreshAfterEdits(edits, kLittleMemory);
  };
  EXPECT_EQ(test::shortestFailing(test::randomEdits(12, GetParam()), check), test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, EditsOfALevel, testing::Range(1u, 11u));

// A reused slot must not keep entries of its previous light.
TEST(VisibilityOfLights, EqualsANewDatabaseAfterAddingAndRemovingLights) {
  const Scene level = test::loadAsset("default");
  const RenderScene scene = test::renderSceneOf(level);
  const std::vector<shared::Vpl> all = test::lightsOf(scene, 70);
  VisibilityDatabase kept;
  kept.setScene(scene, test::everythingRebuilt());
  for (const size_t used : {size_t{70}, size_t{60}, size_t{70}, size_t{20}, size_t{65}}) {
    std::vector<shared::Vpl> lights(all.begin(), all.begin() + static_cast<ptrdiff_t>(used));
    lights.resize(all.size(), shared::Vpl{});  // the number of slots is the same
    kept.setLights(scene, lights);
    VisibilityDatabase fresh;
    fresh.setScene(scene, test::everythingRebuilt());
    fresh.setLights(scene, lights);
    EXPECT_EQ(differences(kept, fresh, used), 0) << used;
    EXPECT_EQ(kept.counts().divided, fresh.counts().divided) << used;
  }
}

}  // namespace
}  // namespace lamplighter
