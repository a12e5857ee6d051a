// Baked irradiance against closed forms, and the methods against the path tracer.
#include "renderer/bake/baked_light.h"

#include <gtest/gtest.h>

#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

struct Baked {
  RenderScene render;
  LightMapAtlas atlas;
  std::vector<BakePoint> points;

  explicit Baked(const Scene& scene, float texelsPerMetre = 8.0f) {
    update(render, scene, SceneChanges::all());
    atlas = makeAtlas(render, {texelsPerMetre, 256});
    points = bakePoints(render, atlas, 0);
  }
  // Irradiance at the texel of object 0 that is nearest to `place`.
  vec3 at(const vec3& place, const BakeLightOptions& options) const {
    const RayCaster rays(render);
    const glm::ivec2 texel(atlas.charts[0].texelsOf(place));
    std::vector<BakePoint> ofTexel;
    for (const BakePoint& p : points)
      if (p.x == texel.x && p.y == texel.y) ofTexel.push_back(p);
    EXPECT_FALSE(ofTexel.empty());
    return BakedLight(render, rays, options).irradiance(ofTexel, 7);
  }
};

BakeLightOptions reference(int bounces) {
  BakeLightOptions o;
  o.method = BakeMethod::reference;
  o.paths.bounces = bounces;
  o.samples = 1024;
  return o;
}

BakeLightOptions settled(int bounces, int vpls = 4096) {
  BakeLightOptions o;
  o.counts = {vpls, 0.5f, bounces, 1};
  return o;
}

BakeLightOptions meshes(int bounces, int mask = 32) {
  BakeLightOptions o;
  o.method = BakeMethod::meshes;
  o.counts.total = 1024;
  o.surface.bounces = bounces;
  o.surface.mask = mask;
  return o;
}

BakeLightOptions links(int bounces) {
  BakeLightOptions o;
  o.method = BakeMethod::links;
  o.counts.total = 1024;
  o.surface.mask = 32;
  o.texels.map = {DepthMapKind::octahedral, 64};
  o.texels.visibility = TexelVisibility::rays;
  o.texels.bounces = bounces;
  return o;
}

// A point below the centre of a rectangle light: E = π L F.
TEST(BakedLight, IsTheFormFactorUnderARectangle) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  test::addRectangleLight(scene, vec3(0, 1.5f, 0), vec2(1, 2), vec3(3, 2, 1));
  const Baked baked(scene);
  const vec3 place(0.0625f, 0, 0.0625f);  // the middle of a texel
  const double factor = test::polygonFormFactor(
      place, vec3(0, 1, 0),
      {{-0.5f, 1.5f, -1}, {0.5f, 1.5f, -1}, {0.5f, 1.5f, 1}, {-0.5f, 1.5f, 1}});
  const float expected = kPi * 3.0f * std::abs(static_cast<float>(factor));
  EXPECT_NEAR(baked.at(place, reference(0)).r, expected, 0.02f * expected);
  EXPECT_NEAR(baked.at(place, settled(0)).r, expected, 0.02f * expected);
  EXPECT_NEAR(baked.at(place, settled(0)).b, expected / 3.0f, 0.01f * expected);
  for (const int mask : {0, 32})
    EXPECT_NEAR(baked.at(place, meshes(0, mask)).r, expected, 2e-3f * expected) << mask;
  EXPECT_NEAR(baked.at(place, links(0)).r, expected, 2e-3f * expected);
}

// Half of a square light is behind a wall that ends above the place.
TEST(BakedLight, OfMeshesIsHalfBehindAHalfPlane) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  test::addMesh(scene, test::boxMesh(vec3(2, 0.01f, 4), test::addMaterial(scene, vec3(0.0f))),
                vec3(1.05f, 1, 0));
  test::addRectangleLight(scene, vec3(0.05f, 2, 0.05f), vec2(1), vec3(3));
  const Baked baked(scene);
  const vec3 place(0.0625f, 0, 0.0625f);  // the middle of a texel
  const double factor = test::polygonFormFactor(
      place, vec3(0, 1, 0),
      {{-0.45f, 2, -0.45f}, {0.0375f, 2, -0.45f}, {0.0375f, 2, 0.55f}, {-0.45f, 2, 0.55f}});
  const float expected = kPi * 3.0f * std::abs(static_cast<float>(factor));
  for (const int mask : {0, 64})
    EXPECT_NEAR(baked.at(place, meshes(0, mask)).r, expected, 0.03f * expected) << mask;
}

// A light that nearly touches the surface fills its hemisphere.
TEST(BakedLight, OfMeshesIsThatOfTheHemisphereUnderATouchingLight) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  test::addRectangleLight(scene, vec3(0, 0.002f, 0), vec2(3), vec3(2));
  const Baked baked(scene);
  for (const int mask : {0, 32})
    EXPECT_NEAR(baked.at(vec3(0.0625f, 0, 0.0625f), meshes(0, mask)).r, 2.0f * kPi, 0.02f) << mask;
}

// A point light near the surface: the law of the inverse square, without a clamp.
TEST(BakedLight, OfMeshesFollowsTheInverseSquareNearAPointLight) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  const NodeId id = test::addNode(scene, "lamp", kNoNode, vec3(0.0625f, 0.1f, 0.0625f));
  scene.find(id)->punctual.emplace().intensity = vec3(2.0f);
  const Baked baked(scene);
  // The mean over the four points of the texel, 1/32 m from its middle along both axes.
  const float d2 = 0.01f + 2.0f / (32.0f * 32.0f);
  const float expected = 2.0f * 0.1f / (d2 * std::sqrt(d2));
  EXPECT_NEAR(baked.at(vec3(0.0625f, 0, 0.0625f), meshes(0)).r, expected, 0.01f * expected);
}

TEST(BakedLight, OfAnEvenSkyIsPiTimesItsRadiance) {
  Scene scene;
  test::addMesh(scene, test::squareMesh(4.0f, test::addMaterial(scene, vec3(0.5f))));
  scene.sky = vec3(2.0f);
  const Baked baked(scene);
  EXPECT_NEAR(baked.at(vec3(1, 0, 1), reference(2)).r, 2.0f * kPi, 0.05f);
  EXPECT_NEAR(baked.at(vec3(1, 0, 1), settled(2)).r, 2.0f * kPi, 0.15f);
  EXPECT_NEAR(baked.at(vec3(1, 0, 1), meshes(2)).r, 2.0f * kPi, 0.15f);
  EXPECT_NEAR(baked.at(vec3(1, 0, 1), links(2)).r, 2.0f * kPi, 0.15f);
}

// A furnace: a closed room of one albedo ρ that emits L everywhere has E = π L (1 + ρ + … + ρ^n)
// after n bounces.
TEST(BakedLight, CountsItsBounces) {
  Scene scene;
  const int glowing = test::addMaterial(scene, vec3(0.5f), vec3(1.0f));
  test::addMesh(scene, test::roomMesh(vec3(2), glowing));
  const Baked baked(scene);
  const RayCaster rays(baked.render);
  for (const int bounces : {0, 1, 3}) {
    const float expected = kPi * (2.0f - std::pow(0.5f, static_cast<float>(bounces)));
    const vec3 e = BakedLight(baked.render, rays, reference(bounces))
                       .irradiance(std::span(baked.points).subspan(200, 1), 3);
    EXPECT_NEAR(e.g, expected, 0.01f * expected) << bounces;
    const vec3 smooth = BakedLight(baked.render, rays, meshes(bounces))
                            .irradiance(std::span(baked.points).subspan(200, 1), 3);
    EXPECT_NEAR(smooth.g, expected, 0.01f * expected) << bounces;
    const BakedLight gathered(baked.render, rays, links(bounces));
    for (size_t i = 0; i < baked.points.size(); i += 53) {
      const vec3 here = gathered.irradiance(std::span(baked.points).subspan(i, 1), 3);
      EXPECT_NEAR(here.g, expected, 0.015f * expected) << bounces << ' ' << i;
    }
  }
}

TEST(BakedLight, AllMethodsAgreeInAShadowedRoom) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::squareMesh(4.0f, white));
  test::addMesh(scene, test::roomMesh(vec3(4), white), vec3(0, 2.001f, 0));
  test::addMesh(scene, test::boxMesh(vec3(0.8f), white), vec3(0.5f, 0.41f, 0));
  test::addRectangleLight(scene, vec3(-0.5f, 3.5f, 0), vec2(1), vec3(10));
  Scene open = scene;  // the room's own floor would coincide with the square
  open.nodes[1].local.translation.y = 1.99f;
  const Baked baked(open);
  for (const vec3 place : {vec3(-1.0f, 0, 0.3f), vec3(1.2f, 0, 0.1f)}) {
    const float a = baked.at(place, reference(2)).g;
    EXPECT_NEAR(baked.at(place, settled(2, 8192)).g, a, 0.08f * a);
    EXPECT_NEAR(baked.at(place, meshes(2)).g, a, 0.05f * a);
    EXPECT_NEAR(baked.at(place, links(2)).g, a, 0.05f * a);
  }
}

// Over all texels of a room with boxes, against many paths.
TEST(BakedLight, GatheredIsNearerToThePathTracerThanInterpolated) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  const int red = test::addMaterial(scene, vec3(0.8f, 0.2f, 0.1f));
  test::addMesh(scene, test::roomMesh(vec3(4, 3, 4), white), vec3(0, 1.5f, 0));
  test::addMesh(scene, test::boxMesh(vec3(1), red), vec3(0.7f, 0.5f, -0.5f));
  test::addMesh(scene, test::boxMesh(vec3(0.6f, 1.6f, 0.6f), white), vec3(-0.9f, 0.8f, 0.2f));
  test::addRectangleLight(scene, vec3(0, 2.8f, 0), vec2(1), vec3(8));
  const Baked baked(scene, 3.0f);
  const RayCaster rays(baked.render);
  const BakedLight truth(baked.render, rays, reference(3));
  BakeLightOptions fine = links(3);
  fine.texels.texel = 0.1f;
  fine.texels.linkError = 0.02f;
  const BakedLight gathered(baked.render, rays, fine), interpolated(baked.render, rays, meshes(3));
  double mean = 0.0, ofGathered = 0.0, ofInterpolated = 0.0;
  size_t count = 0;
  for (size_t i = 0; i < baked.points.size(); i += 7) {
    const auto point = std::span(baked.points).subspan(i, 1);
    const auto texel = static_cast<uint32_t>(i);
    const vec3 expected = truth.irradiance(point, texel);
    if (expected.g < 0.0f) continue;
    ++count;
    mean += static_cast<double>(expected.g);
    const auto squareOf = [&](const BakedLight& light) {
      return std::pow(static_cast<double>(light.irradiance(point, texel).g - expected.g), 2.0);
    };
    ofGathered += squareOf(gathered);
    ofInterpolated += squareOf(interpolated);
  }
  const auto n = static_cast<double>(count);
  const double error = std::sqrt(ofGathered / n) / (mean / n);
  RecordProperty("gathered", std::to_string(error));
  RecordProperty("interpolated", std::to_string(std::sqrt(ofInterpolated / n) / (mean / n)));
  EXPECT_LT(error, 0.025);
  EXPECT_LT(ofGathered, ofInterpolated);
}

// Texels below a box on the floor are marked as unknown (negative); texels beside it are lit.
TEST(BakedLight, MarksTexelsInsideGeometryAsUnknown) {
  Scene scene;
  const int white = test::addMaterial(scene, vec3(0.7f));
  test::addMesh(scene, test::squareMesh(4.0f, white));
  test::addMesh(scene, test::boxMesh(vec3(1), white), vec3(0, 0.49f, 0));
  scene.sky = vec3(1.0f);
  const Baked baked(scene);
  EXPECT_LT(baked.at(vec3(0.1f, 0, 0.1f), settled(0, 64)).r, 0.0f);
  EXPECT_LT(baked.at(vec3(0.1f, 0, 0.1f), meshes(0)).r, 0.0f);
  EXPECT_GT(baked.at(vec3(1.5f, 0, 0.1f), settled(0, 64)).r, 1.0f);
}

}  // namespace
}  // namespace lamplighter
