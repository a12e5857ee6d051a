#include "renderer/sampling/choice/lamp_importance.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr int kSide = 10;

// 100 separate rooms of 4 × 3 × 4 m, each with a point light. The room (3, 3) has a second lamp, an
// area light.
struct Rooms {
  Rooms() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    for (int i = 0; i < kSide * kSide; ++i) {
      const vec3 at(4.5f * static_cast<float>(i % kSide), 1.5f,
                    4.5f * static_cast<float>(i / kSide));
      test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white), at);
      lamps.push_back(test::addNode(scene, "lamp", kNoNode, at + vec3(0.3f, 1.0f, 0.2f)));
      scene.find(lamps.back())->punctual = PunctualLight{PunctualKind::point, vec3(10.0f)};
    }
  }
  // Into the room (3, 3).
  static View view() {
    const vec3 room(13.5f, 1.5f, 13.5f);
    return test::lookAt(room + vec3(-1.7f, 0.1f, -1.7f), room + vec3(1, -0.3f, 1), 64, 48, 1.2f);
  }
  NodeId seen() const { return lamps[33]; }

  Scene scene;
  std::vector<NodeId> lamps;
};

struct Shared {
  std::vector<LampShare> lamps;
  VplSet set;
  std::map<NodeId, int> samples() const {
    std::map<NodeId, int> counts;
    for (const SceneVpl& v : set.vpls) counts[v.id.light] += v.id.bounce == 0;
    return counts;
  }
};

Shared shareFor(const Scene& scene, const VplCounts& counts, const View& view) {
  const test::LitScene lit(scene);
  LightPaths paths;
  paths.update(lit.render, *lit.rays, test::everythingRebuilt(), {}, counts);
  Shared shared;
  LampImportance importance;
  shared.lamps = importance.of(lit.render, *lit.rays, paths, view, 0.5f);
  shared.set = paths.set(lit.render, false, shared.lamps);
  return shared;
}

TEST(LampImportance, LampsOfOtherRoomsGetNoSamples) {
  const Rooms rooms;
  const Shared shared = shareFor(rooms.scene, {300, 0.5f, 0, 1}, Rooms::view());
  ASSERT_EQ(shared.lamps.size(), rooms.lamps.size());
  EXPECT_GT(shared.lamps[33].importance, 0.9f);
  EXPECT_GT(shared.lamps[33].light, 0.8f);
  EXPECT_FALSE(shared.lamps[33].isLeftOut);
  EXPECT_GE(std::count_if(shared.lamps.begin(), shared.lamps.end(),
                          [](const LampShare& l) { return l.isLeftOut; }),
            90);
  EXPECT_LE(shared.set.vpls.size(), 20u);
  EXPECT_EQ(shared.samples()[rooms.seen()], 2);
}

// By flux, the first lamps of the scene would get the samples.
TEST(LampImportance, WithFewSamplesLampsOfTheViewAreServed) {
  Rooms rooms;
  for (const NodeId lamp : rooms.lamps)
    if (lamp != rooms.seen()) rooms.scene.find(lamp)->punctual->intensity *= 3.0f;
  const Shared few = shareFor(rooms.scene, {4, 0.5f, 0, 1}, Rooms::view());
  Shared all = shareFor(rooms.scene, {300, 0.5f, 0, 1}, Rooms::view());
  const auto brightness = [&](const Shared& shared) {
    float sum = 0.0f;
    for (const SceneVpl& v : shared.set.vpls)
      if (v.id.light == rooms.seen()) sum += v.vpl.intensity.r;
    return sum;
  };
  EXPECT_EQ(few.samples()[rooms.seen()], 2);
  EXPECT_LE(few.set.vpls.size(), 4u);
  // It does not represent lamps that the view does not see.
  EXPECT_NEAR(brightness(few), brightness(all), 0.01f * brightness(all));
}

TEST(LampImportance, ALampThatIsSeenIsNeverLeftOut) {
  Rooms rooms;
  const vec3 room(13.5f, 1.5f, 13.5f);
  for (uint32_t i = 0; i < 10; ++i) {
    Rooms more = rooms;
    // Somewhere in the room, also in corners.
    const vec3 u(toUnitFloat(hash4(i, 1, 0, 0)), toUnitFloat(hash4(i, 2, 0, 0)),
                 toUnitFloat(hash4(i, 3, 0, 0)));
    const NodeId added =
        test::addNode(more.scene, "small", kNoNode, room + (u - 0.5f) * vec3(3.9f, 2.9f, 3.9f));
    more.scene.find(added)->punctual = PunctualLight{PunctualKind::point, vec3(0.01f)};
    EXPECT_EQ(shareFor(more.scene, {300, 0.5f, 0, 1}, Rooms::view()).samples()[added], 2) << i;
  }
}

TEST(LampImportance, AreaLightsGetSamplesByWhatTheyBring) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white), vec3(10, 1.5f, 0));
  const NodeId near = test::addRectangleLight(scene, vec3(0, 2.9f, 0), vec2(1), vec3(10));
  const NodeId far = test::addRectangleLight(scene, vec3(10, 2.9f, 0), vec2(1), vec3(40));
  const View view = test::lookAt(vec3(-1.7f, 1.5f, -1.7f), vec3(1, 1, 1), 64, 48, 1.2f);
  std::map<NodeId, int> samples = shareFor(scene, {100, 0.5f, 0, 1}, view).samples();
  EXPECT_GT(samples[near], 3 * samples[far]);
  EXPECT_GE(samples[far], 10);  // shared by flux
  EXPECT_EQ(samples[near] + samples[far], 100);
}

// The mean of the light of both area lights over seeds is their light by flux.
TEST(LampImportance, SharesKeepTheLightOfEachLamp) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::roomMesh(vec3(6, 3, 6), white), vec3(0, 1.5f, 0));
  test::addRectangleLight(scene, vec3(-2, 2.9f, 1), vec2(1), vec3(10));
  test::addRectangleLight(scene, vec3(2, 2.9f, -2), vec2(0.5f), vec3(100));
  const View view = test::lookAt(vec3(-1.7f, 1.5f, -1.7f), vec3(1, 1, 1), 64, 48, 1.2f);
  std::map<NodeId, double> byFlux, byView;
  for (uint32_t seed = 1; seed <= 8; ++seed) {
    const VplCounts counts{64, 0.5f, 0, seed};
    const test::LitScene lit(scene);
    for (const SceneVpl& v :
         LightPaths::generate(lit.render, *lit.rays, LightSet(lit.render), counts).vpls)
      byFlux[v.id.light] += static_cast<double>(luminance(v.vpl.intensity));
    for (const SceneVpl& v : shareFor(scene, counts, view).set.vpls)
      byView[v.id.light] += static_cast<double>(luminance(v.vpl.intensity));
  }
  ASSERT_EQ(byView.size(), 2u);
  for (const auto& [lamp, light] : byFlux) EXPECT_NEAR(byView[lamp] / light, 1.0, 1e-4);
}

TEST(LampImportance, CachedRaysChangeNothing) {
  Rooms rooms;
  const NodeId box =
      test::addMesh(rooms.scene, test::boxMesh(vec3(0.5f), 0), vec3(13.5f, 0.5f, 13.5f));
  RenderScene render;
  MoverFinder finder;
  RenderSceneChanges changes = update(render, rooms.scene, SceneChanges::all());
  finder.update(render, changes);
  RayCaster rays(render);
  LightPaths paths;
  const VplCounts counts{300, 0.5f, 0, 1};
  LampImportance kept;
  for (int step = 0; step < 6; ++step) {
    const Scene before = rooms.scene;
    rooms.scene.find(step % 2 == 0 ? box : rooms.seen())->local.translation +=
        vec3(0.2f, 0.05f, 0.1f);
    if (step == 3) rooms.scene.find(rooms.lamps[34])->local.translation.x -= 4.0f;
    changes = update(render, rooms.scene, compare(before, rooms.scene));
    rays.update(changes);
    const auto movers = finder.update(render, changes);
    kept.outdate(changes, movers);
    paths.update(render, rays, changes, movers, counts);
    LampImportance nothing;
    EXPECT_EQ(kept.of(render, rays, paths, Rooms::view(), 0.5f),
              nothing.of(render, rays, paths, Rooms::view(), 0.5f))
        << step;
  }
}

// After edits the picture is that of a fresh start, also when a lamp comes into view.
TEST(LampImportance, EditsLeaveThePictureOfAFreshStart) {
  Rooms rooms;
  Settings settings;
  settings.set("indirect", std::string("samples"));
  settings.set("bounces", 1);
  settings.set("vpls", 100);
  settings.set("antialias", 1);
  settings.set("bias_compensation", false);
  const View view = Rooms::view();
  FrameRenderer renderer(makeCpuBackend());
  test::settledPicture(renderer, rooms.scene, SceneChanges::all(), view, settings);
  const auto edit = [&](auto&& change) {
    const Scene before = rooms.scene;
    change();
    return test::settledPicture(renderer, rooms.scene, compare(before, rooms.scene), view,
                                settings);
  };
  const Image moved =
      edit([&] { rooms.scene.find(rooms.lamps[34])->local.translation -= vec3(4.4f, 0.5f, 0.0f); });
  EXPECT_TRUE(
      test::sameBits(moved, test::freshPicture(makeCpuBackend(), rooms.scene, view, settings)));
  const Image brighter =
      edit([&] { rooms.scene.find(rooms.lamps[34])->punctual->intensity *= 1.5f; });
  EXPECT_TRUE(
      test::sameBits(brighter, test::freshPicture(makeCpuBackend(), rooms.scene, view, settings)));
}

}  // namespace
}  // namespace lamplighter
