// The recording of ./dev methods-table on every method: every frame shows a picture, each step
// changes it, and the last one is that of a fresh start.
#include "tests/support/level_recording.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/registry/registry.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

class EveryMethod : public testing::TestWithParam<std::string> {};

constexpr int kFrameStep = 10;  // this number of frames of the recording is one here

TEST_P(EveryMethod, PlaysTheRecordingOfTheTable) {
  const test::AssetRoom room("table_room", 48, 36);
  const test::LevelRecording recording(room.scene, room.view);
  Settings settings;
  settings.set("bounces", 2);
  settings.set("antialias", 1);
  settings.set("vpls", 60);
  settings.set("samples_per_pixel", 4);
  const auto frame = [&](FrameRenderer& by, const Scene& scene, const SceneChanges& changes,
                         const View& view) {
    const GiOutput out = by.render({scene, changes, view, GetParam(), settings});
    EXPECT_NE(out.radiance, nullptr);
    return out;
  };
  const auto settled = [&](FrameRenderer& by, const Scene& scene, SceneChanges changes,
                           const View& view) {
    for (int k = 0; k < 2000; ++k, changes = {}) {
      const GiOutput out = frame(by, scene, changes, view);
      if (out.settled) return out.radiance->pixels();
    }
    ADD_FAILURE() << "it does not settle";
    return Image();
  };
  Scene scene = recording.scene();
  FrameRenderer live(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  Image last;
  View view;
  for (size_t step = 0; step < test::LevelRecording::kSteps.size(); ++step) {
    const auto& [name, frames] = test::LevelRecording::kSteps[step];
    test::LevelRecording::State state;
    for (int k = std::min(kFrameStep, frames); k <= frames; k += kFrameStep) {
      state = recording.after(step, k);
      const Scene before = scene;
      recording.apply(state, scene);
      if (step > 0) changes = compare(before, scene);
      frame(live, scene, changes, state.view);
    }
    const Image kept = settled(live, scene, {}, state.view);
    // Ambient occlusion has no brightness.
    EXPECT_EQ(test::sameBits(kept, last), GetParam() == "ambient_occlusion" && name == "brighter")
        << name;
    last = kept;
    view = state.view;
  }
  FrameRenderer fresh(makeCpuBackend());
  EXPECT_TRUE(test::sameBits(last, settled(fresh, scene, SceneChanges::all(), view)));
}
INSTANTIATE_TEST_SUITE_P(Recording, EveryMethod, testing::ValuesIn([] {
                           std::vector<std::string> names;
                           for (const MethodInfo& m : methods()) names.push_back(m.name);
                           return names;
                         }()));

}  // namespace
}  // namespace lamplighter
