// The irradiance accumulator keeps the sums of pixels between edits. Incremental updates per light
// and tile give the bits of a fresh render.
#include <iostream>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

using test::settledPicture;

// The names "transfer", "reflecting transfer" and "blocks of N" mean light maps with that option,
// "glossy" for light maps in a room of glossy surfaces.
Settings settingsOf(const std::string& technique, int vpls) {
  Settings s;
  const bool usesTransfer = technique.ends_with("transfer");
  const bool usesBlocks = technique.starts_with("blocks");
  const bool isGlossy = technique == "glossy";
  s.set("technique",
        usesTransfer || usesBlocks || isGlossy || technique == "meshes" ? "light_maps" : technique);
  // Finer maps of all lights would sum all speculars from scratch at last.
  if (isGlossy) s.set("settled_map_scale", 1);
  s.set("prt", usesTransfer);
  s.set("prt_bounces", technique == "reflecting transfer" ? 4 : 0);
  s.set("block", usesBlocks ? technique.substr(technique.size() - 1) : "1");
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("bounces", 2);
  s.set("updates", 9);
  s.set("map_resolution", 16);
  s.set("antialias", 1);
  if (technique == "meshes") s.set("indirect", std::string("meshes"));
  s.set("share_memory", 0);  // the settled picture is the kept sums
  return s;
}

struct Room : test::AssetRoom {
  explicit Room(bool isComplex = false, bool isGlossy = false) : AssetRoom("pillar_room", 93, 61) {
    for (Material& m : scene.materials)
      if (isGlossy) m.roughness = 0.35f;
    for (Node& node : scene.nodes)
      if (isComplex && node.mesh != kNone) node.meshKind = MeshKind::complex;
  }
};

Image freshPicture(const Room& room, const Settings& settings) {
  return test::freshPicture(makeCpuBackend(), room.scene, room.view, settings);
}

// Renders a few frames after each edit, so that the next edit finds lights half refreshed; then
// settles.
bool equalsFreshRender(const std::string& technique, const test::EditSequence& edits) {
  Room room(technique.ends_with("transfer"), technique == "glossy");
  const Settings settings = settingsOf(technique, 60);
  FrameRenderer renderer(makeCpuBackend());
  settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  for (size_t i = 0; i < edits.size(); ++i) {
    const Scene before = room.scene;
    apply(room.scene, edits[i]);
    SceneChanges changes = compare(before, room.scene);
    for (size_t frame = 0; frame <= i % 4; ++frame, changes = {})
      renderer.render({room.scene, changes, room.view, "many_lights", settings});
  }
  const Image kept = settledPicture(renderer, room.scene, {}, room.view, settings);
  return test::sameBits(kept, freshPicture(room, settings));
}

class KeptSums : public testing::TestWithParam<std::tuple<const char*, uint32_t>> {};

TEST_P(KeptSums, GiveThePictureOfAFreshRender) {
  const auto [technique, seed] = GetParam();
  EXPECT_EQ(test::shortestFailing(test::randomEdits(12, seed),
                                  [&, t = std::string(technique)](const test::EditSequence& s) {
                                    return equalsFreshRender(t, s);
                                  }),
            test::EditSequence());
  if (seed > 2) return;
  EXPECT_EQ(test::shortestFailing(test::randomStructureEdits(8, seed),
                                  [&, t = std::string(technique)](const test::EditSequence& s) {
                                    return equalsFreshRender(t, s);
                                  }),
            test::EditSequence());
}
INSTANTIATE_TEST_SUITE_P(Seeds, KeptSums,
                         testing::Combine(testing::Values("naive", "visibility", "light_maps",
                                                          "transfer", "reflecting transfer",
                                                          "blocks of 2", "blocks of 4",
                                                          "blocks of 8", "glossy", "meshes"),
                                          testing::Range(1u, 5u)));

// Changes of the block size, and of the picture size with the same number of tiles.
TEST(KeptSums, FollowBlockAndPictureSizes) {
  Room room;
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  for (const auto& [block, width] :
       {std::pair("4", 93), {"8", 93}, {"4", 95}, {"1", 95}, {"2", 92}, {"4", 92}, {"1", 93}}) {
    Settings settings = settingsOf("light_maps", 40);
    settings.set("block", std::string(block));
    room.view.width = width;
    const Image kept = settledPicture(renderer, room.scene, changes, room.view, settings);
    EXPECT_TRUE(test::sameBits(kept, freshPicture(room, settings))) << block << ", " << width;
    changes = {};
  }
}

TEST(KeptSums, BlocksHaveTheSameBitsAtAnyNumberOfThreads) {
  Room room;
  std::vector<Image> images;
  for (const size_t threads : {1u, 2u, 5u}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    images.push_back(freshPicture(room, settingsOf("blocks of 4", 60)));
  }
  EXPECT_TRUE(test::sameBits(images[0], images[1]));
  EXPECT_TRUE(test::sameBits(images[0], images[2]));
}

// A frame of a drag costs only the tiles of the moved object and the refreshed lights, far less
// than the whole picture. (The first frame of a lamp's drag also takes away the samples that do not
// follow.)
TEST(KeptSums, ADragCostsOnlyWhatItAffects) {
  Room room;
  Settings settings = settingsOf("light_maps", 100);
  settings.set("updates", 10);
  constexpr int kResolution =
      18;  // not a multiple of a tile, so maps are traced with one ray per texel
  settings.set("map_resolution", kResolution);
  FrameRenderer renderer(makeCpuBackend());
  settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  const auto pixels = static_cast<uint64_t>(room.view.width) * room.view.height;
  const uint64_t all = pixels * 100;
  for (const char* name : {"mover", "ceiling light"}) {
    const auto drag = [&] {
      const Scene before = room.scene;
      for (Node& node : room.scene.nodes)
        if (node.name == name) node.local.translation.x += 0.1f;
      return renderer.render(
          {room.scene, compare(before, room.scene), room.view, "many_lights", settings});
    };
    drag();
    const uint64_t raysAtStart = renderer.backend().counts().rays;
    const ManyLightsCounts start = test::lightCounts(renderer.backend());
    const GiOutput out = drag();
    const ManyLightsCounts end = test::lightCounts(renderer.backend());
    EXPECT_FALSE(out.settled);
    EXPECT_LT(end.lightPixels - start.lightPixels, all / 2) << name;
    EXPECT_GT(end.lightPixels - start.lightPixels, 0u) << name;
    const uint64_t maps = end.shadowMaps - start.shadowMaps;
    const uint64_t rays = renderer.backend().counts().rays - raysAtStart;
    EXPECT_LT(rays - maps * kResolution * kResolution, pixels / 2) << name;
    settledPicture(renderer, room.scene, {}, room.view, settings);
  }
}

// Unchanged lights are looked up again only where the mover may be in their shadow maps. The first
// edit looks up all of them, because recording of the shadow mask cache starts then.
TEST(KeptSums, UnchangedLightsAreLookedUpOnlyWhereTheirMapsChanged) {
  Room room;
  room.view.width = 240;
  room.view.height = 160;
  for (const char* technique : {"visibility", "light_maps", "blocks of 4"}) {
    Settings settings = settingsOf(technique, 100);
    settings.set("updates", 1000);
    settings.set("map_resolution", 64);
    FrameRenderer renderer(makeCpuBackend());
    settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
    std::vector<uint64_t> lookUps;  // by edit
    for (int edit = 0; edit < 4; ++edit) {
      const Scene before = room.scene;
      for (Node& node : room.scene.nodes)
        if (node.name == "mover") node.local.translation.x += 0.05f;
      const uint64_t start = test::lightCounts(renderer.backend()).lookUps;
      renderer.render(
          {room.scene, compare(before, room.scene), room.view, "many_lights", settings});
      lookUps.push_back(test::lightCounts(renderer.backend()).lookUps - start);
    }
    std::cout << technique << ":";
    for (const uint64_t count : lookUps) std::cout << ' ' << count;
    std::cout << " look-ups\n";
    for (size_t edit = 1; edit < lookUps.size(); ++edit)
      EXPECT_LT(lookUps[edit], lookUps[0] * 2 / 3) << technique;
  }
}

// Parts that were outside the view during edits are brought up to date as soon as the camera turns
// to them.
TEST(KeptSums, FollowATurningCamera) {
  Room room;
  for (const char* technique : {"light_maps", "blocks of 4"}) {
    const Settings settings = settingsOf(technique, 60);
    FrameRenderer renderer(makeCpuBackend());
    settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
    const quat initial = room.view.orientation;
    uint32_t turn = 0;
    for (const test::EditSequence& edit : {test::randomEdits(3, 21), test::randomEdits(3, 22),
                                           test::randomEdits(3, 23), test::randomEdits(3, 24)}) {
      for (const auto& one : edit) {
        const Scene before = room.scene;
        apply(room.scene, one);
        renderer.render(
            {room.scene, compare(before, room.scene), room.view, "many_lights", settings});
      }
      settledPicture(renderer, room.scene, {}, room.view, settings);
      room.view.orientation =
          glm::angleAxis(1.3f * static_cast<float>(++turn), vec3(0.0f, 1.0f, 0.0f)) * initial;
      const Image kept = settledPicture(renderer, room.scene, {}, room.view, settings);
      EXPECT_TRUE(test::sameBits(kept, freshPicture(room, settings))) << technique << ", " << turn;
    }
    room.view.orientation = initial;
  }
}

// With coarser light maps, other lights are not eligible, so the shadow modes of unchanged lights
// change.
TEST(KeptSums, FollowChangesOfShadowModes) {
  Room room;
  Settings settings = settingsOf("light_maps", 60);
  FrameRenderer renderer(makeCpuBackend());
  const Image fine = settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  settings.set("light_map_texel", 0.5f);
  const Image kept = settledPicture(renderer, room.scene, {}, room.view, settings);
  EXPECT_TRUE(test::sameBits(kept, freshPicture(room, settings)));
  EXPECT_FALSE(test::sameBits(kept, fine));
}

// During antialiasing, the sums of the unshifted picture are kept for the next edit.
TEST(KeptSums, SurviveAntialiasing) {
  Room room;
  Settings settings = settingsOf("light_maps", 40);
  settings.set("antialias", 4);
  FrameRenderer renderer(makeCpuBackend());
  const Image first =
      settledPicture(renderer, room.scene, SceneChanges::all(), room.view, settings);
  for (const float step : {0.3f, -0.3f}) {
    const Scene before = room.scene;
    for (Node& node : room.scene.nodes)
      if (node.name == "mover") node.local.translation.z += step;
    settledPicture(renderer, room.scene, compare(before, room.scene), room.view, settings);
  }
  const Image second = settledPicture(renderer, room.scene, {}, room.view, settings);
  double most = 0.0;
  for (size_t i = 0; i < first.pixels.size(); ++i)
    most = std::max<double>(most, glm::distance(first.pixels[i], second.pixels[i]));
  // The mover's position is a sum of two steps, with rounding errors.
  EXPECT_LT(most, 0.05);
}

}  // namespace
}  // namespace lamplighter
