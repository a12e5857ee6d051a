// What is kept of visibility from edit to edit of a level, against what is found from nothing:
// entry for entry, else a picture would hang on what was before.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/visibility/visibility_database.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/folders.h"
#include "tests/support/room_lights.h"

namespace lamplighter {
namespace {

RenderSceneChanges everything() {
  RenderSceneChanges all;
  all.rebuilt = true;
  return all;
}

Scene defaultLevel() { return loadGltf(test::sourceFolder() / "assets/scenes/default.gltf").scene; }

// Entries of the first slots that differ.
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

constexpr size_t kLittle = 150000;  // bytes

// The lights stay where they are, so that all entries are only brought up to date. mostBytes: that
// they may take.
bool staysTheSame(const test::EditSequence& edits, size_t mostBytes) {
  Scene level = defaultLevel();
  RenderScene scene;
  update(scene, level, SceneChanges::all());
  const std::vector<shared::Vpl> lights = test::lightsOf(scene, 150);
  VisibilityDatabase kept;
  kept.limitMemory(mostBytes);
  kept.setScene(scene, everything());
  kept.setLights(scene, lights);
  for (const test::Edit& edit : edits) {
    const Scene before = level;
    apply(level, edit);
    kept.setScene(scene, update(scene, level, compare(before, level)));
    kept.refreshAll(scene);
    VisibilityDatabase fresh;
    fresh.limitMemory(mostBytes);
    fresh.setScene(scene, everything());
    fresh.setLights(scene, lights);
    if (kept.objects() != fresh.objects() || differences(kept, fresh) != 0) return false;
    if (kept.counts().divided != fresh.counts().divided) return false;
    if (kept.bytes() > mostBytes) return false;
  }
  return true;
}

class EditsOfALevel : public testing::TestWithParam<uint32_t> {};

TEST_P(EditsOfALevel, LeaveNoEntryOtherThanFromNothing) {
  const auto check = [](const test::EditSequence& edits) {
    return staysTheSame(edits, std::numeric_limits<size_t>::max());
  };
  EXPECT_EQ(test::shortestFailing(test::randomEdits(12, GetParam()), check), test::EditSequence());
}

// What objects that come and go need changes how far all others may be divided.
TEST_P(EditsOfALevel, LeaveNoEntryOtherThanFromNothingWithLittleMemory) {
  const auto check = [](const test::EditSequence& edits) { return staysTheSame(edits, kLittle); };
  EXPECT_EQ(test::shortestFailing(test::randomEdits(12, GetParam()), check), test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, EditsOfALevel, testing::Range(1u, 11u));

// Where slots are used again, a new light's entries may be what the slot had before.
TEST(VisibilityOfLights, IsWhatItIsFromNothingAfterMoreAndFewer) {
  const Scene level = defaultLevel();
  RenderScene scene;
  update(scene, level, SceneChanges::all());
  const std::vector<shared::Vpl> all = test::lightsOf(scene, 70);
  VisibilityDatabase kept;
  kept.setScene(scene, everything());
  for (const size_t used : {size_t{70}, size_t{60}, size_t{70}, size_t{20}, size_t{65}}) {
    std::vector<shared::Vpl> lights(all.begin(), all.begin() + static_cast<ptrdiff_t>(used));
    lights.resize(all.size(), shared::Vpl{});  // slots stay
    kept.setLights(scene, lights);
    VisibilityDatabase fresh;
    fresh.setScene(scene, everything());
    fresh.setLights(scene, lights);
    EXPECT_EQ(differences(kept, fresh, used), 0) << used;
    EXPECT_EQ(kept.counts().divided, fresh.counts().divided) << used;
  }
}

}  // namespace
}  // namespace lamplighter
