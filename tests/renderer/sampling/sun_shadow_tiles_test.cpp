// Placement of sun shadow tiles.
#include "renderer/sampling/sun_shadow_tiles.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "shaders/shared/vpl_shading.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Level {
  Scene scene;
  RenderScene render;
  Level() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    test::addMesh(scene, test::squareMesh(100.0f, white));
    test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(20, 0.5f, 20));
    const NodeId sun = test::addNode(scene, "sun");
    Node& node = *scene.find(sun);
    node.punctual = PunctualLight{PunctualKind::directional, vec3(3)};
    node.local.rotation = glm::angleAxis(-1.2f, vec3(1, 0, 0));
    update(render, scene, SceneChanges::all());
  }
  std::vector<SceneVpl> tiles(const View* view, int count) const {
    const RayCaster rays(render);
    VplCounts counts{64, 0.5f, 0, 1};
    counts.sunMaps = count;
    return generateVpls(render, rays, LightSet(render), counts, view).vpls;
  }
};

// The half side of the tile that contains a point.
float halfSideAt(const std::vector<SceneVpl>& vpls, const vec3& point) {
  float side = 0.0f;
  int found = 0;
  for (const SceneVpl& v : vpls) {
    const vec3 q = shared::vplToLight(v.vpl, point - vec3(v.vpl.position));
    if (std::max(std::abs(q.x), std::abs(q.y)) >= v.vpl.tangent.w) continue;
    side = v.vpl.tangent.w;
    ++found;
  }
  EXPECT_EQ(found, 1) << "tiles must not overlap or leave gaps";
  return side;
}

TEST(SunShadowTiles, AreSmallWhereTheCameraLooks) {
  const Level level;
  const View near = test::lookAt(vec3(-28, 3, -28), vec3(-30, 0, -30), 64, 48);
  const auto seen = level.tiles(&near, 64);
  EXPECT_LE(seen.size(), 64u);
  EXPECT_GT(seen.size(), 32u);
  EXPECT_EQ(sampleCount(seen), 1);
  const float there = halfSideAt(seen, vec3(-30, 0, -30)),
              elsewhere = halfSideAt(seen, vec3(35, 0, -35));
  EXPECT_LT(8.0f * there, elsewhere);
  const auto unseen = level.tiles(nullptr, 64);
  EXPECT_LT(there, halfSideAt(unseen, vec3(-30, 0, -30)));
}

TEST(SunShadowTiles, ASingleTileCoversTheScene) {
  const Level level;
  EXPECT_EQ(level.tiles(nullptr, 1).size(), 1u);
}

// Lit points have more weight than points in shadow, but both are covered.
TEST(SunShadowTiles, CoverEverything) {
  const Level level;
  const View view = test::lookAt(vec3(24, 4, 24), vec3(20, 0, 20), 64, 48);
  const auto tiles = level.tiles(&view, 128);
  for (const vec3 p : {vec3(20, 1, 20), vec3(21, 0, 19), vec3(-40, 0, 33), vec3(3, 0, -45)})
    EXPECT_GT(halfSideAt(tiles, p), 0.0f);
}

}  // namespace
}  // namespace lamplighter
