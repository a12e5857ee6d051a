// The visibility database against rays: entries `visible` and `hidden` are never wrong.
// light_maps_test.cpp tests that results do not depend on earlier edits.
#include "renderer/visibility/visibility_database.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/scenes/random_boxes.h"
#include "tests/support/scenes/room_lights.h"
#include "tests/support/scenes/scene_files.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

struct World {
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  std::vector<shared::Vpl> lights;

  explicit World(const Scene& from, int vpls = 60)
      : scene(test::renderSceneOf(from)),
        rays(std::make_unique<RayCaster>(scene)),
        lights(test::lightsOf(scene, {vpls, 0.5f, 2, 1})) {}
};

// Whether light of the VPL reaches a point of the patch's rectangle or box. Both ends of the ray
// are offset by the tolerance within which the database treats geometry as the surface itself.
bool reaches(const World& w, const shared::Vpl& vpl, const PatchRegion& region, vec3 point) {
  const bool parallel = vpl.position.w == shared::kVplDirectional;
  const vec3 axis(vpl.normal), apex(vpl.position);
  float margin = rayEpsilon(point);
  if (!parallel) margin = std::max(margin, rayEpsilon(apex));
  for (const vec3& c : region.points()) margin = std::max(margin, rayEpsilon(c));
  const vec3 rough = parallel ? axis : apex - point;
  // Points behind the light's plane, including bumps, get no light, wherever the ray begins.
  const bool isBehind = glm::dot(point - apex, axis) + region.thickness <= 0.0f;
  if (region.count == 4) {
    const float side = glm::dot(rough, region.normal) < 0.0f ? -1.0f : 1.0f;
    point += side * 2.0f * (region.thickness + margin) * region.normal;
  }
  if (parallel) return !w.rays->occluded({point, 0.0f, axis});
  if (isBehind) return false;
  const vec3 end = apex + 2.0f * margin * axis;
  if (glm::dot(point - end, axis) <= 0.0f) return false;
  return !w.rays->occluded({point, 0.0f, end - point, 1.0f});
}

// Points of a rectangle are also offset from its border, which often touches another surface, where
// rays are not reliable.
vec3 pointOf(const PatchRegion& region, uint32_t i, uint32_t seed) {
  vec2 u = sobol2(i, seed), v = sobol2(i, seed + 77);
  if (region.count == 4) {
    const vec3 x = region.corners[1] - region.corners[0], y = region.corners[3] - region.corners[0];
    const vec2 border = glm::min(region.rounding / vec2(glm::length(x), glm::length(y)), 0.5f);
    u = glm::clamp(u, border, 1.0f - border);
    return region.corners[0] + u.x * x + u.y * y;
  }
  return region.corners[0] + (region.corners[7] - region.corners[0]) * vec3(u, v.x);
}

struct Contradictions {
  int none = 0, full = 0;        // rays that contradict the entry
  int entries = 0, partial = 0;  // leaves × lights
  int needless = 0;              // partial, although all rays agree
};

Contradictions compareWithRays(const World& w, const VisibilityDatabase& database,
                               uint32_t raysEach, int every = 1) {
  Contradictions m;
  uint32_t seed = 0;
  for (uint32_t object = 0; object < database.objects(); ++object) {
    const ObjectPatches& patches = database.patches(object);
    for (size_t p = 0; p < patches.patches.size(); ++p) {
      if (!patches.patches[p].isLeaf()) continue;
      const PatchRegion region(w.scene, object, patches, patches.patches[p]);
      for (size_t slot = 0; slot < w.lights.size(); ++slot) {
        if (++seed % static_cast<uint32_t>(every) != 0) continue;
        const Occlusion state = database.state(object, static_cast<int>(p), static_cast<int>(slot));
        uint32_t lit = 0;
        for (uint32_t i = 0; i < raysEach; ++i)
          lit += reaches(w, w.lights[slot], region, pointOf(region, i, seed)) ? 1 : 0;
        const vec3 apex(w.lights[slot].position), axis(w.lights[slot].normal);
        ++m.entries;
        m.partial += state == Occlusion::partial;
        m.needless += state == Occlusion::partial && (lit == 0 || lit == raysEach);
        // Light on an invisible back face does not count.
        const vec3 rough =
            w.lights[slot].position.w == shared::kVplDirectional ? axis : apex - region.corners[0];
        const bool unseen = region.frontOnly && glm::dot(rough, region.normal) <= 0.0f;
        m.full += state == Occlusion::full && lit > 0 && !unseen;
        if (state != Occlusion::none) continue;
        // Points behind the light's own plane are dark without an occluder. Rays of a rough chart
        // begin above its bumps and may also be behind the plane.
        uint32_t behind = 0;
        if (w.lights[slot].position.w != shared::kVplDirectional) {
          for (uint32_t i = 0; i < raysEach; ++i)
            behind +=
                glm::dot(pointOf(region, i, seed) - apex, axis) <= 1e-3f + 2.0f * region.thickness
                    ? 1
                    : 0;
        }
        m.none += lit + behind < raysEach;
      }
    }
  }
  return m;
}

void expectRaysAgree(const Scene& scene, uint32_t raysEach, int every = 1, int vpls = 60) {
  const World w(scene, vpls);
  VisibilityDatabase database;
  database.setScene(w.scene, test::everythingRebuilt());
  database.setLights(w.scene, w.lights);
  const Contradictions m = compareWithRays(w, database, raysEach, every);
  EXPECT_EQ(m.none, 0) << "of " << m.entries;
  EXPECT_EQ(m.full, 0) << "of " << m.entries;
  EXPECT_GT(m.entries, 0);
  // The cost of being conservative.
  std::cout << "[ partial  ] " << 100.0 * m.partial / m.entries << "% of " << m.entries
            << " entries, of these not needed according to rays "
            << 100.0 * m.needless / std::max(m.partial, 1) << "%\n";
}

class RandomBoxes : public testing::TestWithParam<uint32_t> {};

TEST_P(RandomBoxes, RaysAgree) {
  Scene scene = test::randomBoxes(20, GetParam());
  test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12.0f));
  expectRaysAgree(scene, 64);
}
INSTANTIATE_TEST_SUITE_P(Seeds, RandomBoxes, testing::Range(1u, 7u));

// A floor that is planar within millimetres, with boxes on it.
TEST(VisibilityDatabase, RaysAgreeOnARoughFloor) {
  Scene scene = test::randomBoxes(12, 3);
  auto mesh = std::make_shared<Mesh>();
  Primitive& p = mesh->primitives.emplace_back();
  constexpr uint32_t kSide = 21;
  for (uint32_t i = 0; i < kSide * kSide; ++i) {
    const vec2 at =
        0.3f * vec2(static_cast<float>(i % kSide), static_cast<float>(i / kSide)) - 3.0f;
    p.positions.emplace_back(at.x, 0.02f + 0.002f * std::sin(5.0f * at.x) * std::cos(4.0f * at.y),
                             at.y);
    p.normals.emplace_back(0, 1, 0);
  }
  for (uint32_t i = 0; i + kSide < kSide * kSide; ++i)
    if (i % kSide + 1 < kSide)
      p.indices.insert(p.indices.end(), {i, i + kSide, i + 1, i + 1, i + kSide, i + kSide + 1});
  test::addMesh(scene, mesh);
  test::addRectangleLight(scene, vec3(0.3f, 3.9f, -0.2f), vec2(1.5f, 0.7f), vec3(12.0f));
  expectRaysAgree(scene, 64);
}

class OwnScene : public testing::TestWithParam<const char*> {};

TEST_P(OwnScene, RaysAgree) { expectRaysAgree(test::loadAsset(GetParam()), 64, 3); }
INSTANTIATE_TEST_SUITE_P(Scenes, OwnScene,
                         testing::Values("default", "area_light_room", "table_room", "pillar_room",
                                         "cornell_style"));

class SharedLevel : public testing::TestWithParam<const char*> {};

TEST_P(SharedLevel, RaysAgree) {
  const std::filesystem::path path = test::sharedScenes() / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  expectRaysAgree(loadGltf(path).scene, 32, 101, 20);
}
INSTANTIATE_TEST_SUITE_P(Levels, SharedLevel,
                         testing::Values("modern-hall/modern-hall.glb", "zdm2-map/zdm2.glb",
                                         "kenney-fps-level/kenney-fps-level.gltf"));

TEST(VisibilityDatabase, AMovedObjectCostsFewTests) {
  Scene scene = test::randomBoxes(40, 3);
  test::addRectangleLight(scene, vec3(0, 3.9f, 0), vec2(1.0f), vec3(12.0f));
  RenderScene render;
  VisibilityDatabase database;
  database.setScene(render, update(render, scene, SceneChanges::all()));
  database.setLights(render, World(scene).lights);
  const uint64_t built = database.tests();
  Scene moved = scene;
  moved.nodes[10].local.translation.x += 0.1f;
  database.setScene(render, update(render, moved, compare(scene, moved)));
  database.refreshAll(render);
  EXPECT_LT(database.tests() - built, built / 4);
}

}  // namespace
}  // namespace lamplighter
