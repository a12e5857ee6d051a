// Where probes are placed: against walls whose place is known, and in all levels.
#include "renderer/probes/probe_grid.h"

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/base/threads.h"
#include "renderer/frame/world.h"
#include "renderer/probes/probe_light.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/surface.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

TEST(ProbeGrid, IsAnchoredInTheWorld) {
  const ProbeGrid a = probeNodes({vec3(-0.3f, 0.1f, 0.9f), vec3(2.2f, 1.4f, 3.0f)}, {});
  EXPECT_EQ(a.first, glm::ivec3(0, 0, 1));
  EXPECT_EQ(a.size, glm::ivec3(3, 2, 3));  // 0 … 2, 0 … 1 and 1 … 3: those within half a metre
  const ProbeGrid b = probeNodes({vec3(-3.7f, 0.1f, 0.9f), vec3(2.2f, 1.4f, 3.0f)}, {});
  EXPECT_EQ(b.first, glm::ivec3(-4, 0, 1));
  EXPECT_EQ(b.placeOf({4, 1, 1}), a.placeOf({0, 1, 1}));
  for (size_t i = 0; i < a.probes.size(); ++i) EXPECT_EQ(a.indexOf(a.nodeAt(i)), i);
  EXPECT_EQ(a.probes[a.indexOf({2, 1, 0})].position, vec3(2, 1, 1));
  EXPECT_TRUE(probeNodes({}, {}).probes.empty());
}

TEST(ProbeGrid, IsCoarserWhereItWouldHaveTooManyNodes) {
  const Bounds bounds{vec3(-2000, -10, -2000), vec3(2000, 10, 2000)};
  const ProbeGrid grid = probeNodes(bounds, {.most = 1000});
  EXPECT_TRUE(grid.isCoarser);
  EXPECT_LE(grid.probes.size(), 1000u);
  EXPECT_GT(grid.probes.size(), 500u);
  EXPECT_FALSE(probeNodes(bounds, {.spacing = 500.0f}).isCoarser);
  EXPECT_TRUE(probeNodes({vec3(-1), vec3(1)}, {.spacing = 1e-6f}).isCoarser);
}

// A closed house of 5.2 × 3.1 × 7.4 m with walls of 0.4 m, and a solid cupboard inside.
struct House {
  vec3 inner{5.2f, 3.1f, 7.4f}, outer = inner + 0.8f, cupboard{1.3f, 2.2f, 0.9f};
  vec3 at{0.37f, 0.2f, -0.1f};  // its centre
  vec3 cupboardAt = at + vec3(1.1f, -0.45f, 0.6f);
  RenderScene render;

  House() {
    Scene scene;
    test::addMesh(scene, test::roomMesh(inner), at);
    test::addMesh(scene, test::boxMesh(outer), at);
    test::addMesh(scene, test::boxMesh(cupboard), cupboardAt);
    render = test::renderSceneOf(scene);
  }
  // Distance to the surface of a box; negative inside.
  static float distance(const vec3& p, const vec3& centre, const vec3& size) {
    const vec3 d = glm::abs(p - centre) - 0.5f * size;
    return glm::length(glm::max(d, vec3(0.0f))) + std::min(std::max({d.x, d.y, d.z}), 0.0f);
  }
  // Of free space; negative in walls and in the cupboard.
  float clearance(const vec3& p) const {
    const float toWalls = std::max(-distance(p, at, inner), distance(p, at, outer));
    return std::min(toWalls, distance(p, cupboardAt, cupboard));
  }
};

TEST(ProbeGrid, HasProbesInFreeSpaceAlone) {
  const House house;
  const RayCaster rays(house.render);
  for (const float spacing : {0.5f, 0.8f, 1.0f}) {
    const ProbeGridOptions options{.spacing = spacing, .padding = 0.2f};
    const ProbeGrid grid = placeProbes(house.render, rays, options);
    size_t wrong = 0, missed = 0, moved = 0, inRoom = 0;
    for (size_t i = 0; i < grid.probes.size(); ++i) {
      const Probe& p = grid.probes[i];
      const vec3 node = grid.placeOf(grid.nodeAt(i));
      if (p.isValid()) {
        wrong += house.clearance(p.position) < 0.99f * options.padding;
        const vec3 offset = glm::abs(p.position - node);
        EXPECT_LE(std::max({offset.x, offset.y, offset.z}), 0.5f * spacing * 1.0001f);
        moved += p.position != node;
        inRoom += House::distance(p.position, house.at, house.inner) < 0.0f;
      } else {
        EXPECT_EQ(p.position, node);
        const bool isIn = House::distance(node, house.at, house.outer) < 0.0f;
        missed += isIn && house.clearance(node) > 1.1f * options.padding;
      }
    }
    EXPECT_EQ(wrong, 0u) << spacing;
    EXPECT_EQ(missed, 0u) << spacing;
    EXPECT_GT(moved, 10u) << spacing;
    const float volume = house.inner.x * house.inner.y * house.inner.z;
    EXPECT_GT(static_cast<float>(inRoom), 0.7f * volume / (spacing * spacing * spacing));
  }
}

// Walls of one side, as in levels of games: behind them is nothing.
TEST(ProbeGrid, HasNoProbesBehindWallsOfOneSide) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(4.5f, 3.3f, 5.5f)));
  test::addMesh(scene, test::squareMesh(2.0f), vec3(8, -1.65f, 0));  // a floor outside
  const RenderScene render = test::renderSceneOf(scene);
  const ProbeGrid grid = placeProbes(render, RayCaster(render), {});
  size_t inRoom = 0, above = 0, wrong = 0;
  for (const Probe& p : grid.probes) {
    if (!p.isValid()) continue;
    const bool isIn = std::abs(p.position.x) < 2.0f && std::abs(p.position.y) < 1.4f &&
                      std::abs(p.position.z) < 2.5f;
    const bool isAbove = p.position.x > 2.25f && p.position.y > -1.65f;
    inRoom += isIn;
    above += isAbove;
    wrong += !isIn && !isAbove;
  }
  EXPECT_EQ(wrong, 0u);
  EXPECT_GE(inRoom, 5u * 3u * 5u);
  EXPECT_GT(above, 0u);
}

// Walls of levels are often at whole metres. A node on a wall belongs to the room, also where the
// wall is seen from both sides.
TEST(ProbeGrid, HasTheNodesOnWallsInTheRoom) {
  for (const bool isDoubleSided : {false, true}) {
    Scene scene;
    const int grey = test::addMaterial(scene, vec3(0.5f));
    scene.materials.back().doubleSided = isDoubleSided;
    test::addMesh(scene, test::roomMesh(vec3(4, 2, 6), grey), vec3(0, 1, 0));
    const RenderScene render = test::renderSceneOf(scene);
    const ProbeGrid grid = placeProbes(render, RayCaster(render), {});
    EXPECT_EQ(grid.size, glm::ivec3(5, 3, 7));
    EXPECT_EQ(grid.count(ProbeState::valid), 5u * 3u * 7u);
    for (const Probe& p : grid.probes) {
      const vec3 room = vec3(2, 1, 3) - glm::abs(p.position - vec3(0, 1, 0));
      EXPECT_GE(std::min({room.x, room.y, room.z}), 0.249f) << isDoubleSided;
    }
  }
}

// What is beside a house with thick walls would leak the light of the sky into its rooms.
TEST(ProbeGrid, HasNoProbesBesideTheLevelButThoseAboveIt) {
  const House house;
  const ProbeGrid grid = placeProbes(house.render, RayCaster(house.render), {});
  const vec3 low = house.render.bounds.min, high = house.render.bounds.max;
  size_t above = 0;
  for (const Probe& p : grid.probes) {
    if (!p.isValid()) continue;
    const vec3 beside = glm::max(low - p.position, p.position - high);
    EXPECT_LE(std::max({beside.x, low.y - p.position.y, beside.z}), 1e-3f);
    above += p.position.y > high.y;
  }
  EXPECT_GT(above, 0u);
}

TEST(ProbeGrid, HasNoUnlitProbesInSolidsThatAreSeenFromBothSides) {
  Scene scene;
  const int grey = test::addMaterial(scene, vec3(0.5f));
  scene.materials.back().doubleSided = true;
  test::addMesh(scene, test::roomMesh(vec3(8, 5, 8), grey));
  test::addMesh(scene, test::boxMesh(vec3(3), grey), vec3(1.2f, 0, 0.4f));
  test::addRectangleLight(scene, vec3(-2, 2.4f, 0), vec2(1), vec3(10));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  ProbeGrid grid = placeProbes(render, rays, {});
  const ProbeReference reference(render, rays, {.bounces = 1});
  markUnlit(render, probeLight(grid, reference.source(16), {}), grid);
  EXPECT_GE(grid.count(ProbeState::inside), 8u);
  for (const Probe& p : grid.probes)
    if (p.isValid()) {
      EXPECT_GT(House::distance(p.position, vec3(1.2f, 0, 0.4f), vec3(3)), 0.24f);
    }
}

TEST(ProbeGrid, IsTheSameWithAnyNumberOfThreads) {
  const House house;
  const RayCaster rays(house.render);
  const auto place = [&](int threads) {
    const ThreadLimit limit(threads);
    return placeProbes(house.render, rays, {.spacing = 0.4f});
  };
  const ProbeGrid one = place(1), two = place(2);
  ASSERT_EQ(one.probes.size(), two.probes.size());
  for (size_t i = 0; i < one.probes.size(); ++i) {
    EXPECT_EQ(one.probes[i].position, two.probes[i].position);
    EXPECT_EQ(one.probes[i].state, two.probes[i].state);
  }
}

using Row = std::map<std::string, std::string>;

class ProbesInLevel : public testing::TestWithParam<Row> {};

// Other rays than those that placed the probes: random ones.
TEST_P(ProbesInLevel, AreNotInsideWalls) {
  const LoadedScene loaded = loadGltf(test::sharedScenes() / GetParam().at("file"));
  World world;
  world.update(loaded.scene, SceneChanges::all());
  const RenderScene& scene = world.scene();
  const ProbeGridOptions options{.spacing = 0.5f, .padding = 0.2f, .most = 4096};
  ProbeGrid grid = placeProbes(scene, *world.rays(), options);
  const ProbeReference reference(scene, *world.rays(), {.bounces = 1});
  const std::vector<ProbeSh> light = probeLight(grid, reference.source(8), {});
  markUnlit(scene, light, grid);
  const size_t valid = grid.count(ProbeState::valid);
  size_t inside = 0, close = 0;
  for (size_t number = 0; number < grid.probes.size(); ++number) {
    const Probe& p = grid.probes[number];
    if (!p.isValid()) continue;
    int backs = 0, turned = 0, hits = 0, near = 0;
    for (uint32_t i = 0; i < 128; ++i) {
      const vec3 direction = sampleSphere(sobol2(i, static_cast<uint32_t>(number)));
      const Hit hit = world.rays()->intersect({p.position, 0.0f, direction});
      if (!hit) continue;
      ++hits;
      near += hit.t < 0.9f * options.padding;
      const Surface s = surfaceAt(scene, hit.object, hit.triangle, hit.u, hit.v);
      if (glm::dot(s.geometricNormal, direction) <= 0.0f) continue;
      ++turned;
      backs += scene.backIsUnseen(hit.object);
    }
    // Where surfaces are seen from both sides, a room may be made of backs, but then it has light.
    inside += hits > 16 && 2 * backs > hits;
    inside += turned > 115 && light[number] == ProbeSh{};
    close += near > 4;
  }
  RecordProperty("valid", static_cast<int>(valid));
  RecordProperty("all", static_cast<int>(grid.probes.size()));
  EXPECT_EQ(inside, 0u) << "of " << valid;
  EXPECT_LE(close, valid / 100) << "nearer to a surface than the padding";
  if (loaded.scene.meshes.size() > 5 && grid.probes.size() > 50) {
    EXPECT_GT(valid, grid.probes.size() / 20);
  }
}
INSTANTIATE_TEST_SUITE_P(All, ProbesInLevel,
                         testing::ValuesIn(test::readTable(test::sharedScenes() / "scenes.tsv")),
                         [](const auto& row) { return test::testNameOf(row.param.at("file")); });
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(ProbesInLevel);

}  // namespace
}  // namespace lamplighter
