// Groups of VPLs that share shadow map look-ups: fewer look-ups with almost the same picture.
#include <algorithm>
#include <iostream>

#include <gtest/gtest.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/light_maps/light_proxies.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scene_files.h"

namespace lamplighter {
namespace {

struct Room : test::AssetRoom {
  explicit Room(const std::string& name) : AssetRoom(name, 160, 100) {}
};

Settings settingsOf(const std::string& technique, int vpls, float groupShare) {
  Settings s;
  s.set("share_memory", 0);  // the settled picture is that of the live sums
  s.set("technique", technique);
  s.set("vpls", vpls);
  s.set("indirect", std::string("samples"));
  s.set("bounces", 1);
  s.set("updates", vpls);
  s.set("antialias", 1);
  s.set("group_share", groupShare);
  return s;
}

struct Result {
  Image image;
  uint64_t lookUps;
};

Result render(const Room& room, const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  const GiOutput out =
      test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  return {out.radiance->pixels(), test::lightCounts(renderer.backend()).lookUps};
}

TEST(GroupedLights, NeedFewerLookUpsForTheSamePicture) {
  for (const char* name : {"pillar_room", "table_room"}) {
    const Room room(name);
    const Result naive = render(room, settingsOf("naive", 1500, 0.4f));
    for (const char* technique : {"visibility", "light_maps"}) {
      SCOPED_TRACE(std::string(name) + " " + technique);
      const Result each = render(room, settingsOf(technique, 1500, 0.0f));
      const Result grouped = render(room, settingsOf(technique, 1500, 0.4f));
      const double error = compareImages(grouped.image, naive.image).relRmse;
      const double bias = compareImages(grouped.image, naive.image).bias;
      std::cout << name << ", " << technique << ": relRMSE to naive " << 100.0 * error
                << "% (without groups " << 100.0 * compareImages(each.image, naive.image).relRmse
                << "%), look-ups " << grouped.lookUps << " for " << each.lookUps << "\n";
      EXPECT_LT(error, 0.03);
      EXPECT_NEAR(bias, 1.0, 0.003);
      EXPECT_LT(3 * grouped.lookUps, 2 * each.lookUps);
    }
  }
}

TEST(GroupedLights, DoNotDependOnEarlierFrames) {
  Room room("pillar_room");
  Settings settings = settingsOf("light_maps", 900, 0.4f);
  settings.set("updates", 250);
  settings.set("map_resolution", 16);
  FrameRenderer renderer(makeCpuBackend());
  test::renderSettled(renderer, room.scene, SceneChanges::all(), room.view, settings);
  for (int edit = 0; edit < 4; ++edit) {
    const Scene before = room.scene;
    for (Node& node : room.scene.nodes) {
      if (edit % 2 == 0 && node.name == "mover") node.local.translation.x += 0.3f;
      if (edit % 2 == 1 && node.area) node.local.translation.z += 0.2f;
    }
    SceneChanges changes = compare(before, room.scene);
    for (int frame = 0; frame < edit; ++frame, changes = {})
      renderer.render({room.scene, changes, room.view, "many_lights", settings});
    const Image edited =
        test::renderSettled(renderer, room.scene, changes, room.view, settings).radiance->pixels();
    EXPECT_TRUE(test::sameBits(edited, render(room, settings).image)) << edit;
  }
}

std::vector<shared::Vpl> row(int count, const vec3& step) {
  std::vector<shared::Vpl> vpls;
  for (int i = 0; i < count; ++i) {
    vpls.push_back(
        test::makeVpl(vec3(0.01f, 0.01f, 0.01f) + static_cast<float>(i) * step, vec3(0, -1, 0)));
    vpls.back().intensity = vec3(1.0f);
    vpls.back().slot = static_cast<int>(i);
  }
  return vpls;
}

LightSampleTable tableOf(std::span<const shared::Vpl> vpls, std::vector<uint8_t> hasMap,
                         std::vector<uint8_t> needsMap) {
  LightSampleTable table;
  for (const shared::Vpl& vpl : vpls) table.samples.emplace_back().vpl = vpl;
  table.summed.assign(vpls.begin(), vpls.end());
  table.hasMap = std::move(hasMap);
  table.needsMap = std::move(needsMap);
  return table;
}

TEST(LightProxies, ALightWithoutAMapUsesThatOfItsNeighbour) {
  const auto vpls = row(4, vec3(1, 0, 0));
  LightProxies lightProxies;
  lightProxies.update(tableOf(vpls, {1, 0, 1, 0}, {1, 0, 1, 1}), {.share = 0.0f, .sees = {}});
  ASSERT_EQ(lightProxies.lights().size(), 1u);  // light 1 is skipped, so it needs no proxy
  const int slot = lightProxies.lights()[0].slot;
  EXPECT_EQ(lightProxies.mapSlot(slot), 2);
  EXPECT_EQ(lightProxies.mapSlot(3), 3);
  EXPECT_FALSE(lightProxies.isGroup(slot));
  std::vector<ShadowMode> uses(lightProxies.slots(), ShadowMode::skip);
  uses[0] = ShadowMode::subtractShadow;
  uses[1] = ShadowMode::add;
  uses[3] = ShadowMode::addShadowed;
  lightProxies.apply(vec3(0, -5, 0), 1.0f, nullptr, uses);
  EXPECT_EQ(uses[0], ShadowMode::subtractShadow);
  EXPECT_EQ(uses[1], ShadowMode::add);
  EXPECT_EQ(uses[3], ShadowMode::skip);
  EXPECT_EQ(uses[static_cast<size_t>(slot)], ShadowMode::addShadowed);
}

TEST(LightProxies, AGroupIsLookedUpOnceAtADistance) {
  const auto vpls = row(4, vec3(0.01f, 0, 0));
  LightProxies lightProxies;
  lightProxies.update(tableOf(vpls, {1, 1, 1, 1}, {1, 1, 1, 1}), {.share = 1.0f, .sees = {}});
  ASSERT_GE(lightProxies.groups(), 1u);
  const shared::Vpl group = lightProxies.lights()[0];
  const auto slot = static_cast<size_t>(group.slot);
  EXPECT_EQ(group.intensity.r, 4.0f);
  EXPECT_TRUE(lightProxies.isGroup(static_cast<int>(slot)));
  const auto usesAt = [&](float y, ShadowMode second) {
    std::vector<ShadowMode> uses(lightProxies.slots(), ShadowMode::skip);
    for (size_t i = 0; i < 4; ++i) uses[i] = ShadowMode::subtractShadow;
    uses[1] = second;
    lightProxies.apply(vec3(0, -y, 0), 0.5f, nullptr, uses);
    return uses;
  };
  const auto far = usesAt(5.0f, ShadowMode::subtractShadow);
  EXPECT_EQ(far[slot], ShadowMode::subtractShadow);
  EXPECT_EQ(std::count(far.begin(), far.end(), ShadowMode::skip),
            static_cast<std::ptrdiff_t>(far.size() - 1));
  for (const auto& uses :
       {usesAt(0.5f, ShadowMode::subtractShadow),  // near
        usesAt(5.0f, ShadowMode::skip)}) {         // one light of the group has another shadow mode
    EXPECT_EQ(uses[slot], ShadowMode::skip);
    EXPECT_EQ(uses[0], ShadowMode::subtractShadow);
  }
  lightProxies.update(tableOf(vpls, {1, 1, 1, 1}, {1, 1, 1, 1}),
                      {.share = 0.3f, .sees = {}});  // its share of the light exceeds the limit
  EXPECT_EQ(lightProxies.groups(), 0u);
}

// A group that is small compared with the specular lobe acts as one light, with or without a
// shadow.
TEST(LightProxies, AGroupActsAsOneLightForWideLobes) {
  auto vpls = row(4, vec3(0.1f, 0, 0));
  for (shared::Vpl& vpl : vpls) vpl.footprint.x = 0.25f;
  LightProxies lightProxies;
  lightProxies.update(tableOf(vpls, {1, 1, 1, 1}, {1, 1, 1, 1}), {.share = 1.0f, .sees = {}});
  const auto groupUse = [&](float alpha, ShadowMode use) {
    std::vector<ShadowMode> uses(lightProxies.slots(), ShadowMode::skip);
    std::fill_n(uses.begin(), 4, use);
    const LightProxies::Lobes lobes{alpha};
    lightProxies.apply(vec3(0, -5, 0), 0.5f, &lobes, uses);
    const shared::Vpl& coarsest = lightProxies.lights()[0];
    EXPECT_EQ(coarsest.footprint.x, 1.0f);
    return uses[static_cast<size_t>(coarsest.slot)];
  };
  for (const ShadowMode use : {ShadowMode::add, ShadowMode::addShadowed}) {
    EXPECT_EQ(groupUse(0.3f, use), use);
    EXPECT_EQ(groupUse(0.02f, use), ShadowMode::skip);  // narrow
    EXPECT_EQ(groupUse(0.0f, use), ShadowMode::skip);
  }
}

// One of the materials is so smooth that lobes show single VPLs, another is rough.
TEST(GroupedLights, GiveTheSameSpecularReflections) {
  Room room("table_room");
  int i = 0;
  for (Material& m : room.scene.materials) {
    m.metallic = 0.6f;
    m.roughness = i++ % 2 == 0 ? 0.25f : 0.6f;
  }
  const Result each = render(room, settingsOf("light_maps", 1500, 0.0f));
  const Result grouped = render(room, settingsOf("light_maps", 1500, 0.4f));
  const auto difference = compareImages(grouped.image, each.image);
  std::cout << "lobes: relRMSE " << 100.0 * difference.relRmse << "%\n";
  EXPECT_GT(difference.relRmse, 0.0);
  EXPECT_LT(difference.relRmse, 0.03);
  EXPECT_NEAR(difference.bias, 1.0, 0.003);
}

// VPLs on the two sides of a wall. As one group, the shadow of the wall would be lost.
TEST(LightProxies, LightsThatDoNotSeeEachOtherFormNoGroup) {
  const auto vpls = row(4, vec3(0.01f, 0, 0));
  const std::vector<uint8_t> all(4, 1);
  LightProxies lightProxies;
  const auto wallAt = [](float x) {
    return [x](const vec3& a, const vec3& b) { return (a.x < x) == (b.x < x); };
  };
  lightProxies.update(tableOf(vpls, all, all), {.share = 1.0f, .sees = wallAt(0.025f)});
  EXPECT_EQ(lightProxies.groups(), 0u);
  // The wall is removed and put back.
  lightProxies.update(tableOf(vpls, all, all),
                      {.share = 1.0f, .sees = wallAt(9.0f), .sceneChanged = true});
  EXPECT_GE(lightProxies.groups(), 1u);
  lightProxies.update(tableOf(vpls, all, all),
                      {.share = 1.0f, .sees = wallAt(0.025f), .sceneChanged = true});
  EXPECT_EQ(lightProxies.groups(), 0u);
}

// A single much brighter VPL, such as sunny ground outdoors, must not raise the limit so that all
// others form groups.
TEST(LightProxies, AFewBrightLightsDoNotRaiseTheLimit) {
  auto vpls = row(8, vec3(0.01f, 0, 0));
  const std::vector<uint8_t> all(8, 1);
  vpls[7].position += vec4(50.0f, 0, 0, 0);
  LightProxies lightProxies;
  lightProxies.update(tableOf(vpls, all, all), {.share = 0.2f, .sees = {}});
  EXPECT_EQ(lightProxies.groups(), 0u);
  vpls[7].intensity = vec3(1e4f);
  lightProxies.update(tableOf(vpls, all, all), {.share = 0.15f, .sees = {}});
  EXPECT_EQ(lightProxies.groups(), 0u);
}

}  // namespace
}  // namespace lamplighter
