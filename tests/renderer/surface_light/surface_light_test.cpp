// Light that bounces between surfaces: closed forms, and what edits trace.
#include "renderer/surface_light/surface_light.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "renderer/base/threads.h"
#include "renderer/surface_light/form_factor.h"
#include "tests/support/edit_sequence.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A room with a box, a screen and lights of two kinds.
struct Room {
  Scene scene;
  NodeId box = kNoNode, lamp = kNoNode, area = kNoNode;

  Room() {
    const int grey = test::addMaterial(scene, vec3(0.6f, 0.5f, 0.4f));
    test::addMesh(scene, test::roomMesh(vec3(4.0f, 3.0f, 5.0f), grey));
    box = test::addMesh(scene, test::boxMesh(vec3(0.8f), grey), vec3(0.5f, -1.0f, 0.3f));
    test::addMesh(scene, test::sphereMesh(0.4f, 40, 0.1f, grey), vec3(-1.0f, -0.9f, -0.5f));
    area = test::addRectangleLight(scene, vec3(0.3f, 1.4f, 0.0f), vec2(0.8f, 0.5f), vec3(9, 8, 7));
    lamp = test::addNode(scene, "lamp", kNoNode, vec3(-1.2f, 0.4f, 1.0f));
    scene.find(lamp)->punctual = PunctualLight{PunctualKind::point, vec3(2, 3, 4)};
  }
};

// A scene as it is edited, with its light.
struct Lit {
  Scene edited;
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  SurfaceLight light;
  SurfaceLightOptions options;
  uint64_t mostRays;  // in each update

  explicit Lit(const Scene& s, int bounces = 3, int mask = 0,
               uint64_t most = SurfaceLight::kAllRays, int gatherRays = 64)
      : edited(s), scene(test::renderSceneOf(s)), mostRays(most) {
    options = {bounces, 0.4f, gatherRays};
    options.mask = mask;
    rays = std::make_unique<RayCaster>(scene);
    light.update(scene, test::everythingRebuilt(), *rays, options, mostRays);
  }
  void edit(const Scene& s) {
    const RenderSceneChanges found = update(scene, s, compare(edited, s));
    edited = s;
    rays->update(found);
    light.update(scene, found, *rays, options, mostRays);
  }
  void goOn() { light.update(scene, {}, *rays, options, mostRays); }
};

// The light of each object; after edits of structure objects and elements have other numbers.
std::map<std::pair<NodeId, int>, std::vector<vec3>> lightByObject(const Lit& lit) {
  std::map<std::pair<NodeId, int>, std::vector<vec3>> out;
  const SurfaceMesh& mesh = lit.light.mesh();
  for (uint32_t o = 0; o < mesh.objects(); ++o) {
    const SurfaceMesh::Part& part = mesh.part(o);
    if (!part.shape) continue;
    const RenderObject& object = lit.scene.objects[o];
    const vec3* values = lit.light.values().data();
    const auto samples = static_cast<uint32_t>(part.shape->samples.size());
    auto& light = out[{object.node, static_cast<int>(object.triangleCount())}];
    EXPECT_TRUE(light.empty());
    light.assign(values + part.firstSample, values + part.firstSample + samples);
    const vec3* blends = values + mesh.samples() + part.firstBlend;
    light.insert(light.end(), blends, blends + part.shape->blends.size());
  }
  return out;
}

void expectSameBits(const Lit& a, const Lit& b) {
  EXPECT_TRUE(lightByObject(a) == lightByObject(b));
}

TEST(FormFactor, IsThatOfARectangleAboveAPoint) {
  // A quarter of the light of a rectangle whose corner is above the point (Siegel and Howell).
  const float a = 0.7f, b = 1.3f, h = 0.9f;
  const std::array<vec3, 4> corners{vec3(0, h, 0), vec3(a, h, 0), vec3(a, h, b), vec3(0, h, b)};
  const double x = a / h, y = b / h, rx = std::sqrt(1 + x * x), ry = std::sqrt(1 + y * y);
  const double expected = 0.5 * (x / rx * std::atan(y / rx) + y / ry * std::atan(x / ry));
  EXPECT_NEAR(polygonFactor(vec3(0.0f), vec3(0, 1, 0), corners), expected, 1e-6);
  // Of the half above the horizon of a vertical receiver.
  const std::array<vec3, 4> wall{vec3(1, -1, -1), vec3(1, 1, -1), vec3(1, 1, 1), vec3(1, -1, 1)};
  const std::array<vec3, 4> upper{vec3(1, 0, -1), vec3(1, 1, -1), vec3(1, 1, 1), vec3(1, 0, 1)};
  EXPECT_NEAR(polygonFactor(vec3(0.0f), vec3(0, 1, 0), wall),
              polygonFactor(vec3(0.0f), vec3(0, 1, 0), upper), 1e-6f);
}

TEST(GatherLinks, DirectionsAreThoseOfEvenLight) {
  const std::vector<vec3> directions = gatherDirections(256, 7);
  double sum = 0.0;
  for (const vec3& d : directions) {
    EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
    sum += d.z;
  }
  EXPECT_NEAR(sum / 256.0, 2.0 / 3.0, 2e-3);  // ∫ cos² θ dω / π
}

// Mean of the bounced light of a closed room with direct light 1 everywhere; all of it, if `all`.
double furnace(int bounces, GatherProjection projection, std::vector<vec3>* all = nullptr) {
  Scene scene;
  test::addMesh(scene, test::roomMesh(vec3(2.0f, 3.0f, 2.5f)));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  SurfaceMesh mesh;
  mesh.update(render, test::everythingRebuilt(), {});
  CutLeaves cuts;
  cuts.update(render, rays, mesh, true, {}, {});
  GatherLinks links;
  links.restart(mesh, 256, 1, projection);
  std::vector<uint32_t> changed;
  links.trace(render, rays, mesh, cuts, SurfaceLight::kAllRays, changed);
  SurfaceState state;
  state.albedo.assign(mesh.leaves(), vec3(0.7f));
  state.direct.assign(3 * mesh.leaves(), vec3(1.0f));
  state.sky.assign(mesh.samples(), vec3(0.0f));
  state.smoothing.update(render, mesh, links, changed, true);
  std::vector<vec3> light;
  ReflectedLight reflected;
  bounceLight(mesh, links, state, bounces, 256, SurfaceLightPart::bounced, light, reflected);
  double sum = 0.0;
  for (const vec3& e : light) sum += e.g;
  if (all) *all = light;
  return sum / static_cast<double>(light.size());
}

TEST(SurfaceLight, FurnaceHasTheLightOfAGeometricSeries) {
  for (const int bounces : {1, 2, 5}) {
    double expected = 0.0;
    for (int k = 1; k <= bounces; ++k) expected += std::pow(0.7, k);
    std::vector<vec3> light;
    furnace(bounces, GatherProjection::hemisphere, &light);
    for (const vec3& e : light) ASSERT_NEAR(e.g, expected, 1e-4 * expected);
  }
}

// The form factor of a square that is seen under 160° from the place below its middle: paper 4
// loses the rest ("about 2%").
TEST(SurfaceLight, FurnaceOfAPlaneLoses248PerCentABounce) {
  const double t = std::tan(glm::radians(80.0)), part = t / std::sqrt(1.0 + t * t);
  const double seen = 4.0 / kPi * part * std::atan(part);
  EXPECT_NEAR(seen, 0.9752, 1e-4);
  for (const int bounces : {1, 2, 5}) {
    double expected = 0.0;
    for (int k = 1; k <= bounces; ++k) expected += std::pow(0.7 * seen, k);
    EXPECT_NEAR(furnace(bounces, GatherProjection::plane), expected, 2e-3 * expected);
  }
}

TEST(SurfaceLight, DirectLightOfAnOpenRectangleIsItsClosedForm) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(3.0f));
  test::addRectangleLight(scene, vec3(0.2f, 1.0f, 0.1f), vec2(0.8f, 0.5f), vec3(4.0f));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  const LightSet lights(render);
  SurfaceMesh mesh;
  mesh.update(render, test::everythingRebuilt(), {});
  const std::vector<uint8_t> isMixed(mesh.leaves(), 0);
  DirectFactors factors;
  factors.update({render, rays, lights, mesh, isMixed, 1, 0}, true, {}, {}, SurfaceLight::kAllRays);
  std::vector<vec3> direct(3 * mesh.leaves());
  factors.sum(lights, direct);
  const std::vector<vec3> corners{
      {-0.2f, 1.0f, -0.15f}, {0.6f, 1.0f, -0.15f}, {0.6f, 1.0f, 0.35f}, {-0.2f, 1.0f, 0.35f}};
  for (uint32_t leaf = 0; leaf < mesh.leaves(); ++leaf) {
    for (size_t c = 0; c < 3; ++c) {
      const SurfaceSpot spot = spotAt(render, mesh.objectOfLeaf(leaf), mesh.placesOfLeaf(leaf)[c]);
      const double expected =
          4.0 * kPi * test::polygonFormFactor(spot.position, vec3(0, 1, 0), corners);
      ASSERT_NEAR(direct[3 * leaf + c].g, expected, 1e-5 * expected + 1e-6);
    }
  }
}

TEST(SurfaceLight, EditsOfBrightnessTraceNothing) {
  Room room;
  Lit lit(room.scene);
  ASSERT_GT(lit.light.counts().rays, 0u);
  const std::vector<vec3> before = lit.light.values();
  room.scene.find(room.area)->area->radiance *= 0.5f;
  room.scene.find(room.lamp)->punctual->intensity *= 0.5f;
  lit.edit(room.scene);
  EXPECT_EQ(lit.light.counts().rays, 0u);
  EXPECT_EQ(lit.light.counts().samplesTraced, 0u);
  EXPECT_EQ(lit.light.counts().factorsFound, 0u);
  for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(lit.light.values()[i], 0.5f * before[i]);
}

TEST(SurfaceLight, MovesLeaveTheBitsOfAFreshStart) {
  Room room;
  Lit lit(room.scene);
  const Lit first(room.scene);
  const vec3 atFirst = room.scene.find(room.box)->local.translation;
  room.scene.find(room.box)->local.translation += vec3(0.35f, 0.1f, -0.6f);
  lit.edit(room.scene);
  EXPECT_GT(lit.light.counts().samplesTraced, 0u);
  EXPECT_LT(lit.light.counts().rays, first.light.counts().rays * 2 / 3);
  expectSameBits(lit, Lit(room.scene));
  room.scene.find(room.box)->local.translation = atFirst;
  lit.edit(room.scene);
  expectSameBits(lit, first);
}

TEST(SurfaceLight, MovedLightsLeaveTheBitsOfAFreshStart) {
  Room room;
  Lit lit(room.scene);
  room.scene.find(room.lamp)->local.translation += vec3(0.3f, 0.0f, 0.2f);
  lit.edit(room.scene);
  // Nothing of the other light, and no gather ray.
  EXPECT_EQ(lit.light.counts().samplesTraced, 0u);
  EXPECT_EQ(lit.light.counts().factorsFound, lit.light.counts().leaves);
  expectSameBits(lit, Lit(room.scene));
  room.scene.find(room.area)->local.translation += vec3(-0.4f, 0.0f, 0.2f);
  lit.edit(room.scene);
  expectSameBits(lit, Lit(room.scene));
}

TEST(SurfaceLight, OpenLightsNeedNoRaysWithMasks) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(3.0f));
  test::addRectangleLight(scene, vec3(0.2f, 1.0f, 0.1f), vec2(0.8f, 0.5f), vec3(4.0f));
  const RenderScene render = test::renderSceneOf(scene);
  const RayCaster rays(render);
  const LightSet lights(render);
  SurfaceMesh mesh;
  mesh.update(render, test::everythingRebuilt(), {});
  const std::vector<uint8_t> isMixed(mesh.leaves(), 0);
  DirectFactors factors;
  EXPECT_EQ(factors.update({render, rays, lights, mesh, isMixed, 1, 64}, true, {}, {},
                           SurfaceLight::kAllRays),
            0u);
  EXPECT_EQ(factors.masked(), 0u);
  EXPECT_GT(factors.open(), mesh.leaves());
}

TEST(SurfaceLight, EditsWithMasksLeaveTheBitsOfAFreshStart) {
  Room room;
  Lit lit(room.scene, 2, 64);
  EXPECT_GT(lit.light.counts().masks, 100u);
  for (const NodeId id : {room.box, room.area, room.box}) {
    room.scene.find(id)->local.translation += vec3(0.2f, 0.05f, -0.3f);
    lit.edit(room.scene);
    expectSameBits(lit, Lit(room.scene, 2, 64));
  }
}

// Whether edits leave the bits of a fresh start. `mostRays`: in each update; updates between edits
// do not finish.
bool endsAsAFreshStart(const test::EditSequence& edits, uint64_t mostRays) {
  Room room;
  Lit lit(room.scene, 2);
  lit.mostRays = mostRays;
  for (const test::Edit& edit : edits) {
    test::apply(room.scene, edit);
    lit.edit(room.scene);
  }
  while (!lit.light.isDone()) lit.goOn();
  return lightByObject(lit) == lightByObject(Lit(room.scene, 2));
}

TEST(SurfaceLight, AnyEditsLeaveTheBitsOfAFreshStart) {
  for (const uint32_t seed : {1u, 2u, 3u}) {
    for (const uint64_t most : {SurfaceLight::kAllRays, uint64_t{3000}}) {
      const auto isSame = [&](const test::EditSequence& e) { return endsAsAFreshStart(e, most); };
      EXPECT_EQ(test::shortestFailing(test::randomEdits(12, seed), isSame), test::EditSequence());
      EXPECT_EQ(test::shortestFailing(test::randomStructureEdits(8, seed), isSame),
                test::EditSequence());
    }
  }
}

TEST(SurfaceLight, RaysAreTracedOverSeveralFrames) {
  const Room room;
  const Lit whole(room.scene, 3, 0, SurfaceLight::kAllRays, 256);
  Lit lit(room.scene, 3, 0, 12000, 256);
  EXPECT_FALSE(lit.light.isDone());
  // The first frame has the light of few rays.
  const auto few = lightByObject(lit), all = lightByObject(whole);
  double sum = 0.0, expected = 0.0;
  for (const auto& [object, light] : all) {
    ASSERT_EQ(few.at(object).size(), light.size());
    for (const vec3& e : light) expected += e.g;
    for (const vec3& e : few.at(object)) sum += e.g;
  }
  EXPECT_NEAR(sum / expected, 1.0, 0.1);
  int frames = 1;
  for (; !lit.light.isDone(); ++frames) {
    lit.goOn();
    // No element is left half way: the first rays of all are traced in the first frame.
    EXPECT_LT(lit.light.counts().rays, 3 * 12000u);
  }
  EXPECT_GT(frames, 10);
  expectSameBits(lit, whole);
}

TEST(SurfaceLight, StructureEditsTraceWhatTheyTouch) {
  Room room;
  Lit lit(room.scene);
  const Lit first(room.scene);
  const auto before = room.scene.nodes;
  test::addMesh(room.scene, test::boxMesh(vec3(0.3f), 0), vec3(-1.2f, -1.2f, 1.5f));
  lit.edit(room.scene);
  EXPECT_LT(lit.light.counts().rays, first.light.counts().rays / 4);
  expectSameBits(lit, Lit(room.scene));
  room.scene.nodes = before;
  lit.edit(room.scene);
  EXPECT_LT(lit.light.counts().rays, first.light.counts().rays / 4);
  expectSameBits(lit, first);
}

TEST(SurfaceLight, MayStartInASceneThatDoesNotChange) {
  const Room room;
  const RenderScene scene = test::renderSceneOf(room.scene);
  const RayCaster rays(scene);
  SurfaceLight a, b;
  a.update(scene, {}, rays, {});
  b.update(scene, test::everythingRebuilt(), rays, {});
  EXPECT_TRUE(a.isDone());
  EXPECT_TRUE(a.values() == b.values());
}

TEST(SurfaceLight, OtherMaterialsTraceNothing) {
  Room room;
  Lit lit(room.scene);
  room.scene.materials[0].baseColor = vec4(0.2f, 0.7f, 0.3f, 1.0f);
  lit.edit(room.scene);
  EXPECT_EQ(lit.light.counts().rays, 0u);
  expectSameBits(lit, Lit(room.scene));
}

TEST(SurfaceLight, DoesNotDependOnThreads) {
  const Room room;
  const Lit two(room.scene);
  const ThreadLimit one(1);
  expectSameBits(Lit(room.scene), two);
}

TEST(SurfaceLight, ThinWallKeepsLightOnItsSide) {
  // A lamp on one side of a wall that is thinner than an element.
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.8f));
  test::addMesh(scene, test::roomMesh(vec3(4.0f, 2.0f, 2.0f), white));
  test::addMesh(scene, test::boxMesh(vec3(0.06f, 2.0f, 2.0f), white), vec3(0.1f, 0.0f, 0.0f));
  const NodeId lamp = test::addNode(scene, "lamp", kNoNode, vec3(-1.0f, 0.5f, 0.0f));
  scene.find(lamp)->punctual = PunctualLight{PunctualKind::point, vec3(5.0f)};
  const Lit lit(scene);
  // What pixels of the floor show: interpolated without what lies behind the wall.
  double lit1 = 0.0, dark = 0.0;
  for (int i = 0; i < 400; ++i) {
    const float x = -1.9f + 3.8f * (static_cast<float>(i) + 0.5f) / 400.0f;
    if (std::abs(x - 0.1f) < 0.04f) continue;
    const vec3 place(x, -0.99f, 0.31f);
    const Hit hit = lit.rays->intersect({place, 0.0f, vec3(0, -1, 0)});
    ASSERT_TRUE(hit);
    MeshPoint point;
    ASSERT_TRUE(
        lit.light.mesh().find(lit.scene, hit.object, hit.triangle, false, {hit.u, hit.v}, point));
    lit.light.cuts().keepVisible(lit.scene, *lit.rays, lit.light.mesh(), place, point.leaf,
                                 point.weights);
    double e = 0.0;
    for (int c = 0; c < 3; ++c)
      e += point.weights[c] * lit.light.values()[point.values[static_cast<size_t>(c)]].g;
    (x < 0.1f ? lit1 : dark) += e;
  }
  EXPECT_GT(lit1, 10.0);
  EXPECT_LT(dark, 0.005 * lit1);
}

}  // namespace
}  // namespace lamplighter
