// Transitions from live to wanted VPLs: consistent in every frame, within the budget, and without
// changes of brightness.
#include "renderer/methods/many_lights/live_lights.h"

#include <algorithm>
#include <functional>
#include <map>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

// Records the VPL for which each slot's map was rendered.
class RecordingKernels : public ManyLightsKernels {
 public:
  std::map<int, shared::Vpl> maps;
  std::map<int, MapSize> sizes;
  int rendered = 0;

  void takeScene(const RenderScene&, const RenderSceneChanges&, const RayCaster&) override {}
  BackendCounts counts() const override { return {}; }
  const ManyLightsTraits& traits() const override { return traits_; }
  ManyLightsCounts lightCounts() const override { return {}; }
  void reserveShadowMaps(int, const MapRoom&, const MapRoom&) override {}
  void dropShadowMaps(std::span<const int> slots) override {
    for (const int slot : slots) maps.erase(slot);
  }
  void renderShadowMaps(std::span<const shared::Vpl> vpls, MapSize size) override {
    for (const shared::Vpl& v : vpls) {
      maps[v.slot] = v;
      sizes[v.slot] = size;
    }
    rendered += static_cast<int>(vpls.size());
  }
  void sumVpls(std::span<const shared::Vpl>, const shared::ShadingParams&,
               const PatchLights*) override {}
  std::shared_ptr<RadianceImage> compose(bool) override { return nullptr; }
  std::shared_ptr<RadianceImage> shareOf(size_t, std::span<const shared::Vpl>,
                                         const shared::ShadingParams&, const PatchLights*,
                                         bool) override {
    return nullptr;
  }
  std::vector<float> readShadowMap(int) override { return {}; }

 private:
  ManyLightsTraits traits_;
};

std::vector<SceneVpl> samples(NodeId light, uint32_t count, float flux, float x) {
  std::vector<SceneVpl> vpls;
  for (uint32_t i = 0; i < count; ++i) {
    SceneVpl v;
    v.vpl = test::makeVpl(vec3(x, static_cast<float>(i), 0), vec3(0, -1, 0));
    v.vpl.intensity = vec3(flux / static_cast<float>(count));
    v.vpl.slot = -1;
    v.id = {light, 0, 0, i};
    vpls.push_back(v);
  }
  return vpls;
}

class LiveLightsTest : public testing::Test {
 protected:
  // Checks that every live VPL is where its shadow map was rendered, and that it has its own slot.
  // Returns the sum of intensities.
  float checkedSum() {
    float sum = 0.0f;
    std::map<int, int> uses;
    for (const shared::Vpl& v : lights.table().summedInOrder()) {
      const int slot = v.slot;
      EXPECT_GE(slot, 0);
      EXPECT_LT(slot, lights.slots());
      EXPECT_EQ(++uses[slot], 1);
      const auto it = kernels.maps.find(slot);
      EXPECT_NE(it, kernels.maps.end());
      if (it == kernels.maps.end()) continue;
      EXPECT_EQ(v.position, it->second.position);
      EXPECT_EQ(v.normal, it->second.normal);
      EXPECT_EQ(v.tangent, it->second.tangent);
      sum += v.intensity.r;
    }
    return sum;
  }

  // Refreshes until nothing is pending and checks the flux in each frame. Returns the number of
  // frames.
  int settle(int budget, float flux) {
    int frames = 0;
    for (; lights.pending() > 0 && frames < 1000; ++frames) {
      const int before = lights.pending(), done = lights.refresh(kernels, {budget});
      EXPECT_LE(done, budget);
      EXPECT_EQ(lights.pending(), before - done);
      EXPECT_NEAR(checkedSum(), flux, 1e-4f * flux);
    }
    return frames;
  }

  RecordingKernels kernels;
  LiveLights lights;
};

TEST_F(LiveLightsTest, FillsUnderTheBudgetAtFullBrightness) {
  lights.want(samples(1, 100, 5.0f, 0.0f));
  EXPECT_EQ(lights.live(), 0);
  EXPECT_EQ(settle(30, 5.0f), 4);
  EXPECT_EQ(kernels.rendered, 100);
  EXPECT_EQ(lights.live(), 100);
}

TEST_F(LiveLightsTest, DuringAMoveEachVplIsEitherOldOrNew) {
  lights.want(samples(1, 100, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.want(samples(1, 100, 5.0f, 7.0f));
  EXPECT_EQ(lights.pending(), 100);
  lights.refresh(kernels, {40});
  const auto shown = lights.table().summedInOrder();
  ASSERT_EQ(shown.size(), 100u);
  EXPECT_EQ(std::count_if(shown.begin(), shown.end(),
                          [](const shared::Vpl& v) { return v.position.x == 7.0f; }),
            40);
  EXPECT_NEAR(checkedSum(), 5.0f, 1e-3f);
  EXPECT_EQ(settle(40, 5.0f), 2);
}

TEST_F(LiveLightsTest, BrightnessAloneNeedsNoMap) {
  lights.want(samples(1, 20, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.clearChanged();
  lights.want(samples(1, 20, 8.0f, 0.0f));
  EXPECT_TRUE(lights.changed());
  EXPECT_EQ(lights.pending(), 0);
  EXPECT_NEAR(checkedSum(), 8.0f, 1e-4f);
  EXPECT_EQ(kernels.rendered, 20);
  lights.clearChanged();
  lights.want(samples(1, 20, 8.0f, 0.0f));
  EXPECT_FALSE(lights.changed());
}

TEST_F(LiveLightsTest, BrightVplsGetFineMapsFirst) {
  std::vector<SceneVpl> wanted = samples(1, 20, 5.0f, 0.0f);
  for (size_t i = 0; i < wanted.size(); ++i)
    wanted[i].vpl.intensity *= 1.0f + static_cast<float>(i);
  lights.want(wanted);
  while (lights.pending() > 0) lights.refresh(kernels, {20});
  std::vector<uint8_t> marked(static_cast<size_t>(lights.slots()), 1);
  marked[0] = 0;
  lights.needMaps(marked);
  EXPECT_EQ(lights.coarse(), 19);
  EXPECT_EQ(lights.sharpenMaps(kernels, 5), 5);
  float coarse = 0.0f, fine = 1e30f;
  for (const auto& [slot, vpl] : kernels.maps) {
    const bool isFine = kernels.sizes[slot] == MapSize::fine;
    if (slot == 0) {
      EXPECT_FALSE(isFine);
    } else if (isFine) {
      fine = std::min(fine, vpl.intensity.r);
    } else {
      coarse = std::max(coarse, vpl.intensity.r);
    }
  }
  EXPECT_GT(fine, coarse);
  EXPECT_EQ(lights.coarse(), 14);
  EXPECT_EQ(lights.sharpenMaps(kernels, 100), 14);
  EXPECT_EQ(lights.sharpenMaps(kernels, 100), 0);
  // Moved VPLs have coarse maps again.
  for (size_t i = 0; i < 3; ++i) wanted[5 + i].vpl.position.x += 1.0f;
  lights.want(wanted);
  lights.refresh(kernels, {20});
  lights.needMaps(marked);
  EXPECT_EQ(lights.coarse(), 3);
}

// A frame reads the table both before and after its shadow maps are rendered.
TEST_F(LiveLightsTest, TheTableFollowsTheMaps) {
  lights.showOnlyMapped(false);
  lights.want(samples(1, 20, 5.0f, 0.0f));
  lights.refresh({20});
  const auto maps = [&] {
    const std::vector<uint8_t>& hasMap = lights.table().hasMap;
    return std::count(hasMap.begin(), hasMap.end(), 1);
  };
  const auto stale = [&] {
    const std::vector<LightSample>& all = lights.table().samples;
    return std::count_if(all.begin(), all.end(), std::mem_fn(&LightSample::isStale));
  };
  EXPECT_EQ(maps(), 0);
  EXPECT_EQ(lights.table().summedInOrder().size(), 20u);
  std::vector<uint8_t> needed(static_cast<size_t>(lights.slots()), 1);
  for (int slot = 0; slot < 5; ++slot) needed[static_cast<size_t>(slot)] = 0;
  lights.needMaps(needed);
  EXPECT_EQ(lights.updateMaps(kernels, {.rendered = 12}), 12);
  EXPECT_EQ(maps(), 12);
  EXPECT_EQ(stale(), 3);
  EXPECT_EQ(lights.updateMaps(kernels, {}), 3);
  EXPECT_EQ(maps(), 15);
  EXPECT_EQ(stale(), 0);
}

TEST_F(LiveLightsTest, ChangingTheNumberOfSamplesKeepsTheBrightness) {
  lights.want(samples(1, 70, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.want(samples(1, 90, 5.0f, 0.0f));  // more
  EXPECT_EQ(lights.pending(), 20);
  EXPECT_NEAR(checkedSum(), 5.0f, 1e-3f);  // before any new VPL is live
  settle(25, 5.0f);
  lights.want(samples(1, 60, 5.0f, 0.0f));  // fewer VPLs need no refresh
  EXPECT_EQ(lights.pending(), 0);
  EXPECT_NEAR(checkedSum(), 5.0f, 1e-3f);
  // Many more VPLs: the maps must be reserved again, but the brightness does not change.
  lights.want(samples(1, 500, 5.0f, 0.0f));
  EXPECT_EQ(settle(100, 5.0f), 5);
  lights.want(samples(1, 3, 5.0f, 0.0f));
  EXPECT_EQ(settle(100, 5.0f), 1);
}

TEST_F(LiveLightsTest, LightsCanBeAddedAndRemoved) {
  auto both = samples(1, 40, 5.0f, 0.0f);
  const auto second = samples(2, 20, 3.0f, 1.0f);
  both.insert(both.end(), second.begin(), second.end());
  lights.want(samples(1, 40, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.want(both);
  EXPECT_EQ(lights.pending(), 20);
  settle(100, 8.0f);
  lights.want(second);
  EXPECT_EQ(lights.pending(), 0);
  EXPECT_NEAR(checkedSum(), 3.0f, 1e-3f);
  lights.want({});
  EXPECT_TRUE(lights.table().summedInOrder().empty());
}

TEST_F(LiveLightsTest, OnlyMapsThatSeeTheMoverAreRefreshed) {
  lights.want(samples(1, 10, 5.0f, 0.0f));  // at heights 0 to 9, facing down
  settle(100, 5.0f);
  const Bounds box{vec3(-1, 6.5f, -1), vec3(1, 6.8f, 1)};
  lights.markStale(std::vector<MoverFinder::Mover>{{box, box}});
  EXPECT_EQ(lights.pending(), 3);
  settle(100, 5.0f);
  EXPECT_EQ(kernels.rendered, 13);
}

// Two bounces of 20 paths; the flux of both together is 5.
std::vector<SceneVpl> bounced(float x, uint32_t lengthOfFirst = 2) {
  std::vector<SceneVpl> vpls;
  for (uint32_t path = 0; path < 20; ++path) {
    for (uint32_t bounce = 1; bounce <= (path == 0 ? lengthOfFirst : 2); ++bounce) {
      SceneVpl v;
      v.vpl = test::makeVpl(vec3(x, path, bounce), vec3(0, -1, 0));
      v.vpl.intensity = vec3(5.0f / 40.0f);
      v.vpl.slot = -1;
      v.id = {1, 0, bounce, path};
      vpls.push_back(v);
    }
  }
  return vpls;
}

std::vector<VplId> pathsOf(uint32_t count) {
  std::vector<VplId> paths;
  for (uint32_t i = 0; i < count; ++i) paths.push_back({1, 0, 1, i});
  return paths;
}

// For any budget, the VPLs of a path are replaced together: there is never an old bounce next to a
// new one.
TEST_F(LiveLightsTest, APathIsReplacedAsAWhole) {
  const auto paths = pathsOf(20);
  lights.want(bounced(0.0f), paths);
  settle(100, 5.0f);
  lights.want(bounced(7.0f), paths);
  EXPECT_EQ(lights.pending(), 40);
  for (int frame = 0; lights.pending() > 0; ++frame) {
    ASSERT_LT(frame, 20);
    EXPECT_LE(lights.refresh(kernels, {5}), 4);
    std::map<float, std::map<float, int>> places;  // for each path: the x positions of its VPLs
    for (const shared::Vpl& v : lights.table().summedInOrder())
      ++places[v.position.y][v.position.x];
    EXPECT_EQ(places.size(), 20u);
    for (const auto& [path, at] : places) {
      EXPECT_EQ(at.size(), 1u);
      EXPECT_EQ(at.begin()->second, 2);
    }
    EXPECT_NEAR(checkedSum(), 5.0f, 1e-4f);
  }
  EXPECT_EQ(kernels.rendered, 80);
}

// VPLs that a path loses stay live until the path is refreshed; VPLs that it gains do not reduce
// the flux before.
TEST_F(LiveLightsTest, APathGetsShorterAndLongerInOneFrame) {
  const auto paths = pathsOf(20);
  const float one = 5.0f / 40.0f;
  lights.want(bounced(0.0f), paths);
  settle(100, 5.0f);
  for (const uint32_t length : {1u, 2u, 0u, 2u}) {
    const float before = checkedSum();
    lights.want(bounced(0.0f, length), paths);
    EXPECT_GT(lights.pending(), 0);
    EXPECT_FLOAT_EQ(checkedSum(), before);
    lights.refresh(kernels, {2});
    EXPECT_EQ(lights.pending(), 0);
    EXPECT_NEAR(checkedSum(), 5.0f - one * static_cast<float>(2 - length), 1e-4f);
  }
  // The VPLs of a removed light are removed at once.
  lights.want({}, {});
  EXPECT_TRUE(lights.table().summedInOrder().empty());
}

// A VPL that returns to its old position before it is refreshed needs no new map.
TEST_F(LiveLightsTest, AnUndoneMoveCostsNoMap) {
  lights.want(samples(1, 20, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.want(samples(1, 20, 5.0f, 7.0f));
  lights.refresh(kernels, {3});
  lights.want(samples(1, 20, 5.0f, 0.0f));
  EXPECT_EQ(lights.pending(), 3);
  settle(100, 5.0f);
  EXPECT_EQ(kernels.rendered, 26);
}

TEST_F(LiveLightsTest, VplsWithoutAMapAreNotLive) {
  lights.want(samples(1, 10, 5.0f, 0.0f));
  settle(100, 5.0f);
  lights.loseMaps();
  EXPECT_TRUE(lights.table().summedInOrder().empty());
  EXPECT_EQ(settle(4, 5.0f), 3);
}

// All maps become outdated in every frame, as during a drag. Every VPL must be refreshed at some
// time.
TEST_F(LiveLightsTest, NoneStarvesWhileAnObjectMoves) {
  auto wanted = samples(1, 30, 300.0f, 0.0f);
  const auto dim = samples(2, 10, 1.0f, 3.0f);
  wanted.insert(wanted.end(), dim.begin(), dim.end());
  lights.want(wanted);
  settle(100, 301.0f);
  const Bounds everywhere{vec3(-99), vec3(99)};
  int oldest = 0;
  for (int frame = 0; frame < 1500; ++frame) {
    lights.markStale(std::vector<MoverFinder::Mover>{{everywhere, everywhere}});
    EXPECT_EQ(lights.refresh(kernels, {10}), 10);
    oldest = std::max(oldest, lights.oldestFrames());
  }
  // The dim VPLs have 1% of the brightness of the others, which are refreshed every three frames.
  EXPECT_GT(oldest, 100);
  EXPECT_LT(oldest, 600);
}

// While a lamp is dragged, the samples that follow it are the same in each frame and carry all its
// light; the others are not shown where the lamp was.
TEST_F(LiveLightsTest, OnlySamplesThatFollowADraggedLampAreShown) {
  const NodeId lamp = 1;
  const auto place = [](float x) { return Bounds{vec3(x, -1, -1), vec3(x + 1, 101, 1)}; };
  const auto shown = [&] {
    std::vector<uint32_t> ids;
    for (const LightSample& s : lights.table().samples)
      if (s.isLive) ids.push_back(s.id.index);
    return ids;
  };
  lights.want(samples(lamp, 100, 10.0f, 0.0f));
  lights.refresh(kernels, {100});
  ASSERT_EQ(shown().size(), 100u);
  std::vector<uint32_t> first;
  for (int frame = 1; frame <= 5; ++frame) {
    SCOPED_TRACE(frame);
    const auto x = static_cast<float>(frame);
    const MoverFinder::Mover mover{place(x - 1.0f), place(x), lamp};
    lights.want(samples(lamp, 100, 10.0f, x));
    lights.markStale({&mover, 1});
    // A budget that varies exchanges none.
    lights.refresh(kernels, {frame % 2 == 0 ? 26 : 20});
    EXPECT_NEAR(checkedSum(), 10.0f, 1e-4f);
    for (const shared::Vpl& v : lights.table().summedInOrder()) EXPECT_EQ(v.position.x, x);
    if (frame == 1) first = shown();
    EXPECT_EQ(shown(), first);
    EXPECT_EQ(first.size(), 12u);
  }
  // At rest, the others follow.
  for (int frame = 0; frame < 5; ++frame) {
    lights.refresh(kernels, {20});
    EXPECT_NEAR(checkedSum(), 10.0f, 1e-4f);
  }
  EXPECT_EQ(shown().size(), 100u);
  EXPECT_EQ(lights.pending(), 0);
}

// With too few that follow, the lamp stays visible as a whole.
TEST_F(LiveLightsTest, FewSamplesDoNotStandForADraggedLamp) {
  const MoverFinder::Mover mover{Bounds{vec3(0), vec3(1)}, Bounds{vec3(1), vec3(2)}, 1};
  lights.want(samples(1, 100, 10.0f, 0.0f));
  lights.refresh(kernels, {100});
  lights.want(samples(1, 100, 10.0f, 1.0f));
  lights.markStale({&mover, 1});
  lights.refresh(kernels, {8});
  EXPECT_EQ(liveSamples(lights.table().samples).size(), 100u);
  EXPECT_NEAR(checkedSum(), 10.0f, 1e-4f);
}

// A dim lamp has light in the first frame, too, even if each sample of a bright one is brighter.
TEST_F(LiveLightsTest, TheFirstFrameHasLightOfEachLamp) {
  std::vector<SceneVpl> wanted = samples(1, 50, 10.0f, 0.0f);
  const std::vector<SceneVpl> dim = samples(2, 50, 5.0f, 3.0f);
  wanted.insert(wanted.end(), dim.begin(), dim.end());
  lights.want(wanted);
  lights.refresh(kernels, {12});
  std::map<NodeId, int> shown;
  for (const SceneVpl& v : liveSamples(lights.table().samples)) ++shown[v.id.light];
  EXPECT_EQ(shown[1], 8);
  EXPECT_EQ(shown[2], 4);
  EXPECT_NEAR(checkedSum(), 15.0f, 1e-4f);
}

}  // namespace
}  // namespace lamplighter
