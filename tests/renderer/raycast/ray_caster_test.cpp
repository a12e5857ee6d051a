#include "renderer/raycast/ray_caster.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// Makes the scene so large that the acceleration structure is updated, not rebuilt, when objects
// move. The added mesh is far from the other objects.
void enlarge(Scene& scene) {
  test::addMesh(scene, test::sphereMesh(1.0f, 120), vec3(0.0f, -50.0f, 0.0f));
}

Ray down(float x, float z) { return {vec3(x, 10.0f, z), 0.0f, vec3(0, -1, 0)}; }

TEST(RayCaster, HitsTheNearestSurface) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f));
  test::addMesh(scene, test::boxMesh(vec3(1.0f)), vec3(0, 2, 0));
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  const Hit box = rays.intersect(down(0.1f, 0.2f));
  ASSERT_TRUE(box);
  EXPECT_EQ(box.object, 1u);
  EXPECT_FLOAT_EQ(box.t, 7.5f);
  const Hit floor = rays.intersect(down(1.5f, 0.0f));
  EXPECT_EQ(floor.object, 0u);
  EXPECT_FLOAT_EQ(floor.t, 10.0f);
  EXPECT_FALSE(rays.intersect(down(3.0f, 0.0f)));
  EXPECT_TRUE(rays.occluded(down(0.0f, 0.0f)));
  EXPECT_FALSE(rays.occluded({vec3(0, 10, 0), 0.0f, vec3(0, -1, 0), 7.0f}));
}

TEST(RayCaster, AnEmptySceneIsHitByNothing) {
  const RenderScene world = test::renderSceneOf(Scene());
  EXPECT_FALSE(RayCaster(world).intersect(down(0, 0)));
}

TEST(RayCaster, EightRaysAtATimeEqualSingleRays) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f));
  test::addMesh(scene, test::boxMesh(vec3(1.0f)), vec3(0, 2, 0));
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  std::mt19937 random(3);
  std::uniform_real_distribution<float> u(-3.0f, 3.0f);
  for (int round = 0; round < 200; ++round) {
    std::array<Ray, 8> r;
    std::array<Hit, 8> h;
    for (Ray& ray : r)
      ray = {vec3(u(random), 6.0f, u(random)), 0.0f,
             glm::normalize(vec3(u(random), -4.0f, u(random)))};
    r[5].tFar = -1.0f;  // an inactive lane
    rays.intersect8(r, h);
    const std::array<bool, 8> occluded = rays.occluded8(r);
    for (size_t i = 0; i < 8; ++i) {
      const Hit one = i == 5 ? Hit() : rays.intersect(r[i]);
      EXPECT_EQ(occluded[i], static_cast<bool>(one));
      EXPECT_EQ(h[i].object, one.object);
      if (one && h[i].triangle == one.triangle) {
        EXPECT_EQ(h[i].t, one.t);
        EXPECT_EQ(h[i].u, one.u);
        EXPECT_EQ(h[i].v, one.v);
      }
    }
  }
}

// Rays through the diagonal of a square, and through the common edge of two squares.
TEST(RayCaster, AtASharedEdgeTheFirstTriangleIsHit) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f));
  test::addMesh(scene, test::squareMesh(4.0f), vec3(4, 0, 0));
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  const auto corner = [&](size_t i) { return world.positions[world.indices[i]]; };
  // The vertices that both triangles of the first square share.
  std::vector<vec3> shared;
  for (size_t i = 0; i < 3; ++i)
    for (size_t j = 3; j < 6; ++j)
      if (corner(i) == corner(j)) shared.push_back(corner(i));
  ASSERT_EQ(shared.size(), 2u);
  for (int i = 1; i < 64; ++i) {
    const vec3 p = glm::mix(shared[0], shared[1], static_cast<float>(i) / 64.0f);
    std::array<Ray, 8> eight;
    eight.fill(down(p.x, p.z));
    std::array<Hit, 8> hits;
    rays.intersect8(eight, hits);
    for (const Hit& hit : {rays.intersect(eight[0]), hits[0], hits[7]}) {
      EXPECT_EQ(hit.object, 0u);
      EXPECT_EQ(hit.triangle, 0u);
    }
    EXPECT_EQ(rays.intersect(down(2.0f, static_cast<float>(i - 32) / 16.0f)).object, 0u);
  }
}

// A camera sees into a room through its ceiling, mirrored or not, unless the material is
// double-sided. Light is blocked by both sides.
TEST(RayCaster, CamerasSeeThroughTheBacksOfSingleSidedFaces) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.5f));
  const NodeId room = test::addMesh(scene, test::roomMesh(vec3(2.0f), white));
  for (const float mirror : {1.0f, -1.0f}) {
    scene.find(room)->local.scale.x = mirror;
    for (const bool doubleSided : {false, true}) {
      scene.materials[white].doubleSided = doubleSided;
      const RenderScene world = test::renderSceneOf(scene);
      const RayCaster rays(world);
      const float expected = doubleSided ? 9.0f : 11.0f;
      EXPECT_FLOAT_EQ(rays.intersect(down(0.1f, 0.2f), Surfaces::seen).t, expected);
      std::array<Ray, 8> r;
      std::array<Hit, 8> h;
      r.fill(down(0.1f, 0.2f));
      rays.intersect8(r, h, Surfaces::seen);
      EXPECT_FLOAT_EQ(h[3].t, expected);
      EXPECT_FLOAT_EQ(rays.intersect(down(0.1f, 0.2f)).t, 9.0f);
      EXPECT_TRUE(rays.occluded({vec3(0.1f, 10, 0.2f), 0.0f, vec3(0, -1, 0), 10.0f}));
    }
  }
}

TEST(RayCaster, FollowsAMovedObject) {
  Scene scene;
  const NodeId box = test::addMesh(scene, test::boxMesh(vec3(1.0f)));
  test::addMesh(scene, test::squareMesh(20.0f), vec3(0, -3, 0));
  RenderScene world = test::renderSceneOf(scene);
  RayCaster rays(world);
  EXPECT_FLOAT_EQ(rays.intersect(down(0, 0)).t, 9.5f);
  Scene moved = scene;
  moved.find(box)->local.translation.x = 5.0f;
  rays.update(update(world, moved, compare(scene, moved)));
  EXPECT_FLOAT_EQ(rays.intersect(down(0, 0)).t, 13.0f);
  EXPECT_FLOAT_EQ(rays.intersect(down(5, 0)).t, 9.5f);
}

class MovesIn : public testing::TestWithParam<bool> {};

// Hits must have the same bits (distance and barycentrics) whether objects were moved or the
// structure was built with them in place: recordings compare bits after an undo.
TEST_P(MovesIn, GiveTheBitsOfANewAccelerationStructure) {
  Scene before;
  for (int i = 0; i < 40; ++i) {
    const float x = static_cast<float>(i);
    test::addMesh(before, test::boxMesh(vec3(1.0f, 0.3f + 0.02f * x, 0.7f)),
                  vec3(std::fmod(x * 0.37f, 4.0f) - 2.0f, 0.0f, std::fmod(x * 0.73f, 4.0f) - 2.0f));
  }
  if (GetParam()) enlarge(before);
  Scene after = before;
  for (const int i : {3, 17, 18, 30}) after.nodes[i].local.translation.y += 0.25f;
  RenderScene world = test::renderSceneOf(before);
  RayCaster moved(world);
  moved.update(update(world, after, compare(before, after)));
  const RenderScene fresh = test::renderSceneOf(after);
  const RayCaster built(fresh);
  int hits = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    const vec2 at = 5.0f * sobol2(i, 1) - 2.5f, to = 5.0f * sobol2(i, 2) - 2.5f;
    const Ray ray{vec3(at.x, 3.0f, at.y), 0.0f, vec3(to.x - at.x, -3.0f, to.y - at.y)};
    const Hit a = moved.intersect(ray), b = built.intersect(ray);
    ASSERT_EQ(a.object, b.object);
    ASSERT_EQ(a.triangle, b.triangle);
    ASSERT_EQ(a.t, b.t);
    ASSERT_EQ(a.u, b.u);
    ASSERT_EQ(a.v, b.v);
    ASSERT_EQ(moved.occluded(ray), static_cast<bool>(a));
    Ray ended = ray;
    ended.tFar = 0.5f;
    std::array<Ray, 8> eight;
    eight.fill(ray);
    eight[2] = ended;
    eight[7].tFar = -1.0f;
    const std::array<bool, 8> occluded = moved.occluded8(eight);
    ASSERT_EQ(occluded[0], static_cast<bool>(a));
    ASSERT_EQ(occluded[2], moved.occluded(ended));
    ASSERT_FALSE(occluded[7]);
    hits += a ? 1 : 0;
  }
  EXPECT_GT(hits, 5000);
}

INSTANTIATE_TEST_SUITE_P(LargeScenesToo, MovesIn, testing::Bool());

// Rays that certainly miss a moved object skip the test with it. Rays that hit it must never be
// skipped, be it at an edge, parallel to an axis or far from the origin.
TEST(RayCaster, SkipsMovedObjectsOnlyForRaysThatMissThem) {
  for (const float away : {0.0f, 3000.0f}) {
    Scene before;
    const vec3 middle(away, 1.0f, -away);
    const NodeId box = test::addMesh(before, test::boxMesh(vec3(1.0f, 2.0f, 0.5f)), middle);
    Scene after = before;
    after.find(box)->local.translation.x += 0.5f;
    RenderScene world = test::renderSceneOf(before);
    RayCaster moved(world);
    moved.update(update(world, after, compare(before, after)));
    const RenderScene fresh = test::renderSceneOf(after);
    const RayCaster built(fresh);
    const vec3 centre = middle + vec3(0.5f, 0.0f, 0.0f);
    int hits = 0;
    for (uint32_t i = 0; i < 2000; ++i) {
      std::array<Ray, 8> rays;
      for (uint32_t lane = 0; lane < 8; ++lane) {
        const vec2 u = 2.0f * sobol2(8 * i + lane, 1) - 1.0f, v = sobol2(8 * i + lane, 2);
        // Points on the surface, on its edges and just outside; every second ray is parallel to an
        // axis.
        vec3 at(u.x, u.y, v.x < 0.5f ? -1.0f : 1.0f);
        if (i % 4 > 1) at.x = at.x < 0.0f ? -1.0f : 1.0f;
        if (i % 8 > 5) at.y = 1.0f + 1e-4f * u.x;
        const vec3 to = centre + at * vec3(0.5f, 1.0f, 0.25f);
        const vec3 from = i % 2 == 0 ? to + vec3(0.0f, 0.0f, 3.0f * at.z)
                                     : centre + vec3(4.0f * u.y, 3.0f * v.y, 2.0f * at.z);
        rays[lane] = {from, 0.0f, to - from};
      }
      std::array<Hit, 8> a, b;
      moved.intersect8(rays, a);
      built.intersect8(rays, b);
      for (size_t lane = 0; lane < 8; ++lane) {
        const Hit one = moved.intersect(rays[lane]);
        ASSERT_EQ(a[lane].t, b[lane].t);
        ASSERT_EQ(one.t, built.intersect(rays[lane]).t);
        ASSERT_EQ(moved.occluded(rays[lane]), built.occluded(rays[lane]));
        hits += a[lane] ? 1 : 0;
      }
    }
    EXPECT_GT(hits, 5000);
    EXPECT_LT(hits, 16000);
  }
}

TEST(RayCaster, FollowsMaterialsThatBecomeTransparentOrMasked) {
  Scene before;
  const int m = test::addMaterial(before, vec3(1.0f));
  test::addMesh(before, test::squareMesh(2.0f, m), vec3(0, 2, 0));
  test::addMesh(before, test::squareMesh(2.0f));
  RenderScene world = test::renderSceneOf(before);
  RayCaster rays(world);
  const auto change = [&](auto edit) {
    Scene after = before;
    edit(after.materials[m]);
    rays.update(update(world, after, compare(before, after)));
    before = after;
    return rays.intersect(down(0.1f, 0.2f)).object;
  };
  EXPECT_EQ(change([](Material& x) { x.transmission = 1.0f; }), 1u);
  EXPECT_EQ(change([](Material& x) { x.transmission = 0.0f; }), 0u);
  EXPECT_EQ(change([](Material& x) {
              x.alphaMode = AlphaMode::mask;
              x.baseColor.a = 0.2f;
            }),
            1u);
  EXPECT_EQ(change([](Material& x) { x.alphaCutoff = 0.1f; }), 0u);
}

TEST(RayCaster, PassesTransparentPanesAndHolesOfMasks) {
  Scene scene;
  const int glass = test::addMaterial(scene, vec3(1.0f));
  scene.materials[glass].transmission = 1.0f;
  const int leaf = test::addMaterial(scene, vec3(1.0f));
  auto image = std::make_shared<Image8>(2, 1);
  image->at(0, 0)[3] = 0;  // the left half is a hole
  scene.textures.push_back({"leaf", image, Wrap::clamp, Wrap::clamp, true, false});
  scene.materials[leaf].alphaMode = AlphaMode::mask;
  scene.materials[leaf].baseColorTexture.texture = 0;
  test::addMesh(scene, test::squareMesh(2.0f, glass), vec3(0, 3, 0));
  test::addMesh(scene, test::squareMesh(2.0f, leaf), vec3(0, 2, 0));
  test::addMesh(scene, test::squareMesh(2.0f), vec3(0, 0, 0));
  const RenderScene world = test::renderSceneOf(scene);
  const RayCaster rays(world);
  EXPECT_EQ(rays.intersect(down(-0.5f, 0.1f)).object, 2u);
  EXPECT_EQ(rays.intersect(down(0.5f, 0.1f)).object, 1u);
  EXPECT_TRUE(rays.occluded({vec3(0.5f, 10, 0.1f), 0.0f, vec3(0, -1, 0), 9.0f}));
  EXPECT_FALSE(rays.occluded({vec3(-0.5f, 10, 0.1f), 0.0f, vec3(0, -1, 0), 9.0f}));
  std::array<Ray, 8> eight;
  for (size_t i = 0; i < 8; ++i)
    eight[i] = {vec3(i % 2 == 0 ? 0.5f : -0.5f, 10, 0.1f), 0.0f, vec3(0, -1, 0), 9.0f};
  const std::array<bool, 8> occluded = rays.occluded8(eight);
  for (size_t i = 0; i < 8; ++i) EXPECT_EQ(occluded[i], i % 2 == 0);
}

}  // namespace
}  // namespace lamplighter
