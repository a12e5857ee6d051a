// A level in another unit of length has the picture of the same level in metres, bit for bit.
#include "tests/renderer/frame/scaled_levels.h"

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

constexpr float kFactors[] = {0x1p-10f, 0x1p10f, 0x1p20f};

TEST(ScaledLevels, HaveTheSameBitsWithEachTechnique) {
  for (const char* technique : {"naive", "visibility", "light_maps"}) {
    SCOPED_TRACE(technique);
    const Settings settings = test::settingsOfTechnique(technique);
    const Image metres = test::pictureOfRoom(makeCpuBackend(), 1.0f, "many_lights", settings);
    for (const float factor : kFactors)
      EXPECT_TRUE(test::sameBits(
          metres, test::pictureOfRoom(makeCpuBackend(), factor, "many_lights", settings)))
          << factor;
  }
}

TEST(ScaledLevels, HaveTheSameBitsWithTheReference) {
  Settings settings;
  settings.set("paths_per_pixel", 4);
  const Image metres = test::pictureOfRoom(makeCpuBackend(), 1.0f, "reference", settings);
  for (const float factor : kFactors)
    EXPECT_TRUE(test::sameBits(
        metres, test::pictureOfRoom(makeCpuBackend(), factor, "reference", settings)))
        << factor;
}

// Rooms in millimetres: the unit is 1,024 and not 1,000 of them, so all lengths differ by 2%.
TEST(ScaledLevels, InMillimetresAreAsBrightAsInMetres) {
  Settings settings = test::settingsOfTechnique("light_maps");
  settings.set("vpls", 400);
  const float metres =
      luminance(test::meanOf(test::pictureOfRoom(makeCpuBackend(), 1.0f, "many_lights", settings)));
  const float millimetres =
      luminance(test::meanOf(test::pictureOfRoom(makeCpuBackend(), 1e3f, "many_lights", settings)));
  EXPECT_NEAR(millimetres / metres, 1.0f, 0.02f);
}

// An edit that makes another unit suit the level, and its undo.
TEST(ScaledLevels, AnEditIntoAnotherUnitLeavesThePictureOfAFreshStart) {
  const Settings settings = test::settingsOfTechnique("light_maps");
  const Scene before = test::roomOfAllLights();
  const View view = test::viewOfRoom(93, 61);
  FrameRenderer renderer(makeCpuBackend());
  const Image first = test::settledPicture(renderer, before, SceneChanges::all(), view, settings);
  EXPECT_EQ(renderer.scene().unit, 1.0f);
  Scene after = before;
  for (Node& n : after.nodes) {
    n.local.translation *= 2048.0f;
    n.local.scale *= 2048.0f;
  }
  const View far = test::scaledView(view, 2048.0f);
  const Image second = test::settledPicture(renderer, after, compare(before, after), far, settings);
  EXPECT_EQ(renderer.scene().unit, 1024.0f);
  EXPECT_TRUE(test::sameBits(second, test::freshPicture(makeCpuBackend(), after, far, settings)));
  EXPECT_TRUE(test::sameBits(
      first, test::settledPicture(renderer, before, compare(after, before), view, settings)));
  EXPECT_EQ(renderer.scene().unit, 1.0f);
}

}  // namespace
}  // namespace lamplighter
