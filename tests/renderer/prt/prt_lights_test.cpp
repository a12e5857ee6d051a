// Incident light on complex objects with transfer, without a picture.
#include "renderer/prt/prt_lights.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "renderer/base/threads.h"
#include "renderer/prt/incident_light.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using shared::Vpl;

// A scene with rays, visibility database and transfer lighting, updated incrementally.
class World {
 public:
  explicit World(int bounces = 0, int points = 32) {
    options.transfer = {256, bounces};
    options.mostPoints = points;
  }
  void show(const std::vector<Vpl>& vpls, const SceneChanges& edit = SceneChanges::all()) {
    const RenderSceneChanges changes = update(render, scene, edit);
    if (!rays) {
      rays = std::make_unique<RayCaster>(render);
    } else {
      rays->update(changes);
    }
    visibility.setScene(render, changes);
    visibility.setLights(render, vpls);
    visibility.refreshAll(render);
    prt.update(render, changes, *rays, visibility,
               {vpls, std::vector<bool>(vpls.size(), true), areLast}, options, true);
    visibility.clearChanged();
  }
  // Compares the results with those of a new World.
  bool equalsFresh(const std::vector<Vpl>& vpls) const {
    World other;
    other.options = options;
    other.areLast = areLast;
    other.scene = scene;
    other.show(vpls);
    for (uint32_t i = 0; i < prt.objects(); ++i) {
      const auto a = prt.irradiance(i), b = other.prt.irradiance(i);
      if (a.size() != b.size() ||
          (!a.empty() && std::memcmp(a.data(), b.data(), a.size_bytes()) != 0))
        return false;
      const auto heldA = prt.held(i), heldB = other.prt.held(i);
      if (!a.empty() && !std::equal(heldA.begin(), heldA.end(), heldB.begin(), heldB.end()))
        return false;
    }
    return true;
  }

  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  VisibilityDatabase visibility;
  PrtLights prt;
  PrtLights::Options options;
  std::vector<bool> areLast;  // for each light: it is of the last bounce
};

Vpl brightVpl(const vec3& position, const vec3& normal, float intensity,
              float kind = shared::kVplCosine) {
  Vpl vpl = test::makeVpl(position, normal, kind);
  vpl.intensity = intensity * vec3(1.0f, 0.8f, 0.5f);
  return vpl;
}

NodeId addComplex(Scene& scene, std::shared_ptr<const Mesh> mesh, const vec3& at) {
  const NodeId id = test::addMesh(scene, std::move(mesh), at);
  scene.find(id)->meshKind = MeshKind::complex;
  return id;
}

TEST(PrtLights, OfADistantSourceEqualDirectLightOnASphere) {
  for (const int points : {1, 32}) {
    World world(0, points);
    const NodeId id = addComplex(world.scene, test::sphereMesh(0.5f, 24), vec3(1, 2, 3));
    world.scene.find(id)->local.rotation = glm::normalize(quat(0.3f, 0.5f, -0.2f, 0.7f));
    world.scene.find(id)->local.scale = vec3(1.3f);
    const vec3 from(9, 13, -14);
    const Vpl vpl = brightVpl(from, vec3(1, 2, 3) - from, 400.0f);
    world.show({vpl});
    const auto irradiance = world.prt.irradiance(0);
    ASSERT_EQ(irradiance.size(), world.render.positions.size());
    const float facing = incidentLight(vpl, vec3(1, 2, 3), 0.0f).value().irradiance.g;
    for (size_t v = 0; v < irradiance.size(); ++v) {
      const vec3 &p = world.render.positions[v], &n = world.render.normals[v];
      const float expected = shared::vplGeometry(vpl, p, n, n, 0.0f) * vpl.intensity.g;
      // The truncation error (spherical_harmonics_test.cpp). A single light point also ignores that
      // one side of the sphere is nearer: 2 · 0.65 m / 20 m.
      const float tolerance = 15.0f / 256.0f + (points == 1 ? 0.07f : 0.01f);
      EXPECT_NEAR(irradiance[v].g, expected, tolerance * facing);
      EXPECT_NEAR(irradiance[v].r * 0.8f, irradiance[v].g, 1e-4f * facing);
      EXPECT_GE(irradiance[v].g, 0.0f);
    }
  }
}

// A parallel light over a square of ten metres.
Vpl parallelVpl(const vec3& position, const vec3& towards, float intensity) {
  Vpl vpl = brightVpl(position, towards, intensity, shared::kVplDirectional);
  vpl.normal.w = 10.0f;
  vpl.tangent.w = 5.0f;
  return vpl;
}

// A sky with this light and 30 others that miss the scene.
std::vector<Vpl> skyWith(const Vpl& vpl) {
  std::vector<Vpl> sky = {vpl};
  for (int i = 0; i < 30; ++i)
    sky.push_back(
        parallelVpl(vec3(1000, 0, 0), vec3(0, 1, 0.01f * static_cast<float>(i + 1)), 2.0f));
  return sky;
}

float brightest(const World& world) {
  float most = 0.0f;
  for (const vec3& e : world.prt.irradiance(0)) most = std::max(most, e.r);
  return most;
}

TEST(PrtLights, OfAParallelLightEndAtTheBorderOfItsSquare) {
  World world;
  addComplex(world.scene, test::sphereMesh(0.5f, 16), vec3(0.0f));
  Vpl light = parallelVpl(vec3(0.0f), vec3(0, 1, 0), 2.0f);
  world.show(skyWith(light));
  EXPECT_NEAR(brightest(world), 2.0f, 0.1f);
  light.position.x = 6.0f;
  world.show(skyWith(light), SceneChanges());
  EXPECT_EQ(brightest(world), 0.0f);
}

// Shadows of a single sun are too hard for light points. The same light as part of a sky is not.
TEST(PrtLights, LeaveASunToPixels) {
  World world;
  addComplex(world.scene, test::sphereMesh(0.5f, 16), vec3(0.0f));
  const Vpl light = parallelVpl(vec3(0.0f), vec3(0, 1, 0), 2.0f);
  std::vector<Vpl> alone = skyWith(light);
  for (size_t i = 1; i < alone.size(); ++i) alone[i] = Vpl{};
  for (const bool isAlone : {true, false, true}) {
    const std::vector<Vpl>& vpls = isAlone ? alone : skyWith(light);
    world.show(vpls, isAlone ? SceneChanges::all() : SceneChanges());
    EXPECT_EQ(world.prt.held(0)[0], isAlone ? 0 : 1);
    EXPECT_EQ(brightest(world) > 1.0f, !isAlone);
    EXPECT_TRUE(world.equalsFresh(vpls));
  }
}

// Figure 4-14: a bar of four metres, half of it below a roof.
class HalfShadowedBar : public testing::Test {
 protected:
  void light(World& world) {
    const NodeId id = addComplex(world.scene, test::sphereMesh(0.5f, 32), vec3(0.0f));
    world.scene.find(id)->local.scale = vec3(4.0f, 0.4f, 0.4f);
    test::addMesh(world.scene, test::boxMesh(vec3(8, 0.1f, 8)), vec3(4, 2, 0));
    vpl_ = brightVpl(vec3(0, 40, 0), vec3(0, -1, 0), 1600.0f);
    world.show({vpl_});
  }
  // The irradiance relative to that without shadows, at a vertex on top of the bar near x.
  float shareAt(const World& world, float x) const {
    const RenderObject& bar = world.render.objects[0];
    float nearest = 1e9f, share = 0.0f;
    for (uint32_t v = 0; v < bar.vertexCount; ++v) {
      const vec3 &p = world.render.positions[v], &n = world.render.normals[v];
      if (n.y < 0.9f || std::abs(p.x - x) > nearest) continue;
      nearest = std::abs(p.x - x);
      share = world.prt.irradiance(0)[v].g /
              (shared::vplGeometry(vpl_, p, n, n, 0.0f) * vpl_.intensity.g);
    }
    return share;
  }
  Vpl vpl_{};
};

TEST_F(HalfShadowedBar, ShowsTheBorderOfTheShadow) {
  World world;
  light(world);
  for (const float x : {-1.5f, -1.2f, -0.9f}) EXPECT_NEAR(shareAt(world, x), 1.0f, 0.07f) << x;
  for (const float x : {0.9f, 1.2f, 1.5f}) EXPECT_NEAR(shareAt(world, x), 0.0f, 0.01f) << x;
  // The irradiance decreases along the bar, and its half value is close to the border of the
  // shadow.
  float last = 1.1f, middle = -10.0f;
  for (float x = -1.5f; x < 1.5f; x += 0.1f) {
    const float share = shareAt(world, x);
    EXPECT_LE(share, last + 0.07f) << x;
    if (share > 0.5f) middle = x;
    last = share;
  }
  EXPECT_NEAR(middle, 0.0f, 0.4f);
}

TEST_F(HalfShadowedBar, ShowsNoBorderWithThePapersSinglePoint) {
  World world(0, 1);
  light(world);
  EXPECT_NEAR(shareAt(world, -1.5f), shareAt(world, 1.5f), 0.05f);
}

// The transfer contains the object's own shadow. Rays that hit the object itself would make it
// dark.
TEST(PrtLights, AreNotOccludedByTheObjectItself) {
  World world(0, 1);
  addComplex(world.scene, test::sphereMesh(0.5f, 16), vec3(0.0f));
  world.show({brightVpl(vec3(0, 20, 0), vec3(0, -1, 0), 400.0f)});
  const auto irradiance = world.prt.irradiance(0);
  EXPECT_NEAR(irradiance[0].r, 1.0f, 0.06f);
  EXPECT_GT(world.prt.rays(), 0u);
}

TEST(PrtLights, CountLightFromTheObjectItselfOnce) {
  World world(2);
  addComplex(world.scene, test::sphereMesh(0.5f, 16, 0.1f), vec3(0.0f));
  world.show({});
  const vec3 p = world.render.positions[40], n = world.render.normals[40];
  // A VPL where a light path has hit the object, and a VPL just above it.
  const Vpl on = brightVpl(p + rayEpsilon(p) * n, n, 1.0f);
  const Vpl over = brightVpl(p + 0.01f * n, n, 1.0f);
  EXPECT_TRUE(liesOn(*world.rays, 0, on));
  EXPECT_FALSE(liesOn(*world.rays, 0, over));
  world.show({on, over}, SceneChanges());
  EXPECT_EQ(world.prt.held(0)[0], 1) << "must not be left to pixels";
  EXPECT_EQ(world.prt.held(0)[1], 0) << "too near for interpolation between light points";
  for (const vec3& e : world.prt.irradiance(0)) EXPECT_EQ(e, vec3(0.0f));
}

TEST(PrtLights, ExcludeObjectsThatTransferCannotLight) {
  World world;
  Scene& scene = world.scene;
  const int glowing = test::addMaterial(scene, vec3(0.5f), vec3(1.0f));
  addComplex(scene, test::sphereMesh(0.5f, 8, 0.0f, glowing), vec3(0, 0, 0));
  // Two charts with narrow side faces.
  test::addMesh(scene, test::boxMesh(vec3(2.0f, 0.05f, 2.0f)), vec3(5, 0, 0));
  const NodeId flat = addComplex(scene, test::sphereMesh(0.5f, 8), vec3(10, 0, 0));
  scene.find(flat)->local.scale = vec3(1, 0, 1);
  addComplex(scene, test::sphereMesh(0.5f, 8), vec3(15, 0, 0));
  world.show({brightVpl(vec3(7, 20, 0), vec3(0, -1, 0), 400.0f)});
  EXPECT_TRUE(world.prt.irradiance(0).empty());
  EXPECT_TRUE(world.prt.irradiance(1).empty());
  EXPECT_TRUE(world.prt.irradiance(2).empty());
  EXPECT_FALSE(world.prt.irradiance(3).empty());
}

class PrtLightsOfError : public testing::TestWithParam<float> {};

TEST_P(PrtLightsOfError, DoNotDependOnEarlierStates) {
  World world(1);
  world.options.mostError = GetParam();
  Scene& scene = world.scene;
  const NodeId bumpy = addComplex(scene, test::sphereMesh(0.5f, 12, 0.1f), vec3(0.0f));
  addComplex(scene, test::sphereMesh(0.4f, 10), vec3(2, 0, 0));
  const NodeId box = test::addMesh(scene, test::boxMesh(vec3(0.5f)), vec3(1, 1, 0));
  std::vector<Vpl> vpls;
  for (int i = 0; i < 24; ++i) {
    const float phi = 2.4f * static_cast<float>(i);
    const vec3 at(4.0f * std::cos(phi), 1.0f + 0.2f * static_cast<float>(i), 4.0f * std::sin(phi));
    vpls.push_back(brightVpl(at, -at, 1.0f + static_cast<float>(i)));
  }
  world.show(vpls);
  EXPECT_TRUE(world.equalsFresh(vpls));

  const auto moved = [](NodeId id) {
    SceneChanges changes;
    changes.moved = {id};
    return changes;
  };
  scene.find(box)->local.translation = vec3(1.5f, 1.2f, 0.1f);
  world.show(vpls, moved(box));
  EXPECT_TRUE(world.equalsFresh(vpls)) << "an occluder moved";
  scene.find(bumpy)->local.translation = vec3(0.3f, 0.2f, 0.1f);
  scene.find(bumpy)->local.rotation = glm::normalize(quat(0.9f, 0.3f, 0.2f, 0.1f));
  world.show(vpls, moved(bumpy));
  EXPECT_TRUE(world.equalsFresh(vpls)) << "an object moved and rotated";
  vpls[3] = brightVpl(vec3(3, 5, 1), vec3(-1, -1, 0), 7.0f);
  vpls[9].intensity *= 0.3f;
  vpls[12] = Vpl{};
  world.show(vpls, SceneChanges());
  EXPECT_TRUE(world.equalsFresh(vpls)) << "lights changed, one was removed";
  vpls.push_back(brightVpl(vec3(-3, 5, 1), vec3(1, -1, 0), 7.0f));
  world.show(vpls, SceneChanges());
  EXPECT_TRUE(world.equalsFresh(vpls)) << "a light was added";
}

INSTANTIATE_TEST_SUITE_P(Errors, PrtLightsOfError, testing::Values(1.0f, 0.3f, 0.15f, 0.0f));

// Lights that light points represent badly are left to pixels; their reflections within the object
// remain.
TEST_F(HalfShadowedBar, IsLeftToPixelsIfTheErrorExceedsTheLimit) {
  for (const int bounces : {0, 2}) {
    World all(bounces), direct(0), some(bounces);
    some.options.mostError = 0.1f;
    light(all), light(direct), light(some);
    EXPECT_EQ(all.prt.held(0)[0], 1);
    EXPECT_EQ(some.prt.held(0)[0], 0);
    EXPECT_EQ(all.prt.left().wholly, 0);
    EXPECT_EQ(some.prt.left().objects, 1);
    EXPECT_EQ(some.prt.left().wholly, 1);
    const auto a = all.prt.irradiance(0), d = direct.prt.irradiance(0), s = some.prt.irradiance(0);
    for (size_t v = 0; v < s.size(); ++v) {
      if (d[v].g > 0.0f) {
        EXPECT_NEAR(s[v].g, std::max(a[v].g - d[v].g, 0.0f), 1e-5f);
      }
    }
  }
}

// The VPLs of the last bounce light directly but are not reflected, whether they were so from the
// start or became so. If they are left to pixels, they add nothing.
TEST(PrtLights, DoNotReflectLightOfTheLastBounce) {
  const Vpl vpl = brightVpl(vec3(3, 6, 1), vec3(-3, -6, -1), 60.0f);
  World all(2), direct(0), last(2), left(2);
  last.areLast = left.areLast = {true};
  left.options.mostError = 0.001f;
  for (World* world : {&all, &direct, &last, &left}) {
    addComplex(world->scene, test::sphereMesh(0.5f, 16, 0.2f), vec3(0.0f));
    world->show({vpl});
  }
  EXPECT_EQ(last.prt.held(0)[0], 1);
  EXPECT_EQ(left.prt.held(0)[0], 0);
  const std::vector<vec3> whole(all.prt.irradiance(0).begin(), all.prt.irradiance(0).end());
  const auto d = direct.prt.irradiance(0), l = last.prt.irradiance(0);
  float reflected = 0.0f;
  for (size_t v = 0; v < whole.size(); ++v) {
    EXPECT_NEAR(l[v].g, d[v].g, 1e-5f);
    EXPECT_EQ(left.prt.irradiance(0)[v], vec3(0.0f));
    reflected = std::max(reflected, whole[v].g - d[v].g);
  }
  EXPECT_GT(reflected, 0.01f) << "without reflections the test proves nothing";
  all.areLast = {true};
  all.show({vpl}, SceneChanges());
  EXPECT_TRUE(std::equal(l.begin(), l.end(), all.prt.irradiance(0).begin()));
  EXPECT_TRUE(all.equalsFresh({vpl}));
  all.areLast = {false};
  all.show({vpl}, SceneChanges());
  EXPECT_TRUE(std::equal(whole.begin(), whole.end(), all.prt.irradiance(0).begin()));
}

class PrtLightsInRoom : public testing::TestWithParam<size_t> {};

// A scaled mesh gets other transfer and another number of light points, so the memory for other
// objects changes.
TEST_P(PrtLightsInRoom, FollowScaledMeshes) {
  World world(2);
  world.options.mostPoints = 128;
  world.options.mostBytes = GetParam();
  const NodeId id = addComplex(world.scene, test::sphereMesh(0.5f, 16), vec3(0));
  addComplex(world.scene, test::sphereMesh(0.3f, 12), vec3(1.4f, 0, 0));
  const std::vector<Vpl> vpls = {brightVpl(vec3(3, 4, 1), vec3(-3, -4, -1), 40.0f),
                                 brightVpl(vec3(-3, 2, 3), vec3(3, -2, -3), 30.0f)};
  world.show(vpls);
  int lacked = 0;
  for (const vec3 scale :
       {vec3(1.3f), vec3(3, 1, 1), vec3(-3, 1, 1), vec3(6), vec3(1, 0, 1), vec3(0.2f), vec3(1)}) {
    const Scene before = world.scene;
    world.scene.find(id)->local.scale = scale;
    world.show(vpls, compare(before, world.scene));
    EXPECT_TRUE(world.equalsFresh(vpls)) << scale.x << ", " << scale.y;
    EXPECT_LE(world.prt.bytes(), GetParam());
    lacked += world.prt.left().withoutRoom;
    const bool isFlat = scale.y == 0.0f;
    EXPECT_EQ(world.prt.left().objects + world.prt.left().withoutRoom, isFlat ? 1 : 2);
  }
  EXPECT_EQ(lacked > 0, GetParam() < SIZE_MAX);
}
INSTANTIATE_TEST_SUITE_P(Rooms, PrtLightsInRoom, testing::Values(SIZE_MAX, 400000, 250000));

TEST(PrtLights, LeaveNothingToPixelsForAnUnshadowedSphere) {
  World world;
  world.options.mostError = 0.05f;
  addComplex(world.scene, test::sphereMesh(0.5f, 32), vec3(0.0f));
  std::vector<Vpl> vpls;
  for (int i = 0; i < 32; ++i) {
    const float phi = 2.4f * static_cast<float>(i), y = static_cast<float>(2 * i - 31) / 32.0f;
    const vec3 to(std::sqrt(1.0f - y * y) * std::cos(phi), y,
                  std::sqrt(1.0f - y * y) * std::sin(phi));
    vpls.push_back(brightVpl(20.0f * to, -to, 100.0f));
  }
  world.show(vpls);
  for (const uint8_t held : world.prt.held(0)) EXPECT_EQ(held, 1);
}

TEST(PrtLights, KeepTheShadowsOfPendingLights) {
  World world;
  addComplex(world.scene, test::sphereMesh(0.5f, 12), vec3(0.0f));
  const NodeId box = test::addMesh(world.scene, test::boxMesh(vec3(3, 0.2f, 3)), vec3(9, 2, 0));
  const std::vector<Vpl> vpls{brightVpl(vec3(0, 9, 0), vec3(0, -1, 0), 40.0f)};
  world.show(vpls);
  const std::vector<vec3> lit(world.prt.irradiance(0).begin(), world.prt.irradiance(0).end());
  world.scene.find(box)->local.translation = vec3(0, 2, 0);
  SceneChanges edit;
  edit.moved = {box};
  const RenderSceneChanges changes = update(world.render, world.scene, edit);
  world.rays->update(changes);
  world.visibility.setScene(world.render, changes);
  world.visibility.setLights(world.render, vpls);
  const auto prt = [&](const RenderSceneChanges& c, bool upToDate) {
    world.prt.update(world.render, c, *world.rays, world.visibility, {vpls, {upToDate}, {}},
                     world.options, true);
  };
  prt(changes, false);
  EXPECT_TRUE(std::equal(lit.begin(), lit.end(), world.prt.irradiance(0).begin()));
  world.visibility.refreshAll(world.render);
  prt(RenderSceneChanges(), true);
  for (const vec3& e : world.prt.irradiance(0)) EXPECT_EQ(e, vec3(0.0f));
}

TEST(PrtLights, HaveTheSameBitsAtAnyNumberOfThreads) {
  const auto lit = [](int threads) {
    const ThreadLimit limit(threads);
    World world(1);
    world.options.mostError = 0.2f;
    addComplex(world.scene, test::sphereMesh(0.5f, 16, 0.1f), vec3(0.0f));
    world.show({brightVpl(vec3(0, 3, 1), vec3(0, -1, 0), 40.0f),
                brightVpl(vec3(3, 1, 0), vec3(-1, 0, 0), 20.0f)});
    const auto e = world.prt.irradiance(0);
    return std::vector<vec3>(e.begin(), e.end());
  };
  EXPECT_EQ(lit(1), lit(4));
}

// The nearest light points of a vertex are blended, and the blending is continuous.
TEST(IncidentLightPoints, AreSpreadOverTheObjectAndBlendedSmoothly) {
  Scene scene;
  test::addMesh(scene, test::sphereMesh(0.5f, 48));
  const RenderScene render = test::renderSceneOf(scene);
  const RenderScene own = ownSceneOf(render, 0, ownSpaceOf(render.objects[0]).value());
  EXPECT_EQ(placeIncidentLightPoints(own, 1).places.size(), 1u);
  EXPECT_LT(glm::length(placeIncidentLightPoints(own, 1).places[0]), 1e-3f);
  const IncidentLightPoints points = placeIncidentLightPoints(own, 16);
  ASSERT_EQ(points.places.size(), 16u);
  EXPECT_LT(points.spacing, 0.45f);
  const auto weightsOf = [&](size_t v) {
    std::array<float, 16> out{};
    for (size_t k = 0; k < IncidentLightPoints::kBlended; ++k)
      out[points.ofVertex[v].point[k]] += points.ofVertex[v].weight[k];
    return out;
  };
  for (size_t v = 0; v + 1 < own.positions.size(); ++v) {
    const auto here = weightsOf(v), next = weightsOf(v + 1);
    float sum = 0.0f;
    const float step = glm::distance(own.positions[v], own.positions[v + 1]);
    for (size_t i = 0; i < here.size(); ++i) {
      sum += here[i];
      // Steps along a ring are at most 0.033 m. Longer steps lead to the next ring and are skipped.
      if (step < 0.1f) {
        EXPECT_NEAR(here[i], next[i], 12.0f * step + 1e-4f);
      }
    }
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
  }
}

TEST(IncidentLightPoints, TheirNumberFollowsTheSizeOfTheObject) {
  EXPECT_EQ(lightPointsFor(0.1f, 32), 1);
  EXPECT_EQ(lightPointsFor(1.0f, 128), 64);
  EXPECT_EQ(lightPointsFor(1.0f, 8), 8);
  EXPECT_EQ(lightPointsFor(100.0f, 1000), kMostLightPoints);
  EXPECT_EQ(lightPointsFor(1e30f, 32), 32);
}

}  // namespace
}  // namespace lamplighter
