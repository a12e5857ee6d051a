// The path tracer against closed forms.
#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "renderer/scene/light_shapes.h"
#include "tests/support/render.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

using test::lookAt;
using test::meanOf;
using test::renderReference;

// The unit sphere seen from inside, with albedo ρ, emitting Le everywhere.
Scene furnace(float albedo, float emission) {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(albedo), vec3(emission));
  Primitive p = tessellate({AreaShape::sphere, vec3(0.0f), vec2(2.0f)});
  for (size_t i = 0; i < p.indices.size(); i += 3) std::swap(p.indices[i + 1], p.indices[i + 2]);
  for (vec3& n : p.normals) n = -n;
  p.material = material;
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(p);
  test::addMesh(scene, mesh);
  return scene;
}

class Furnace : public testing::TestWithParam<int> {};

// All paths meet the same radiance: L = Le · Σ ρᵏ for k = 0 … bounces + 1.
TEST_P(Furnace, RadianceIsTheGeometricSeries) {
  const int bounces = GetParam();
  const View view = lookAt(vec3(0.2f, 0.1f, 0.0f), vec3(0, 0, -1), 16, 16, 1.2f);
  const Image image = renderReference(furnace(0.5f, 3.0f), view, 128, bounces);
  const float expected = 3.0f * (1.0f - std::pow(0.5f, static_cast<float>(bounces + 2))) / 0.5f;
  EXPECT_NEAR(meanOf(image).g / expected, 1.0f, 4e-3f);
}
INSTANTIATE_TEST_SUITE_P(Bounces, Furnace, testing::Values(0, 1, 2, 5, 20));

// A third of this light comes from bounces after the eighth, where Russian roulette ends paths.
TEST(ClosedForm, RussianRouletteKeepsTheMean) {
  const View view = lookAt(vec3(0.2f, 0.1f, 0.0f), vec3(0, 0, -1), 16, 16, 1.2f);
  const Image image = renderReference(furnace(0.9f, 1.0f), view, 256, 64);
  const double expected = (1.0 - std::pow(0.9, 66.0)) / 0.1;
  EXPECT_NEAR(static_cast<double>(meanOf(image).g) / expected, 1.0, 6e-3);
}

// A convex body under a sky of constant radiance L sees only the sky: its radiance is ρL.
TEST(ClosedForm, AConvexBodyUnderAConstantSkyHasRadianceRhoL) {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(0.2f, 0.5f, 0.8f));
  test::addMesh(scene, test::boxMesh(vec3(2.0f), material));
  scene.sky = vec3(2.0f);
  const View view = lookAt(vec3(3, 2.5f, 4), vec3(0), 16, 16, 0.2f);  // all pixels show the box
  const vec3 mean = meanOf(renderReference(scene, view, 256, 3));
  EXPECT_NEAR(mean.r, 0.4f, 0.4f * 3e-3f);
  EXPECT_NEAR(mean.g, 1.0f, 1.0f * 3e-3f);
  EXPECT_NEAR(mean.b, 1.6f, 1.6f * 3e-3f);
}

// A small part of the floor at x, seen from above at an angle.
View viewOfFloor(const vec3& x, int pixels = 8) {
  return lookAt(x + vec3(0.3f, 1.0f, 0.4f), x, pixels, pixels, 0.01f);
}

TEST(ClosedForm, APatchUnderARectangleLightHasThePolygonsFormFactor) {
  Scene scene;
  const int material = test::addMaterial(scene, vec3(0.6f));
  test::addMesh(scene, test::squareMesh(10.0f, material));
  test::addRectangleLight(scene, vec3(0.5f, 2.0f, -0.3f), vec2(1.5f, 0.8f), vec3(7.0f));
  const std::vector<vec3> light{
      {-0.25f, 2, -0.7f}, {1.25f, 2, -0.7f}, {1.25f, 2, 0.1f}, {-0.25f, 2, 0.1f}};
  for (const vec3& x : {vec3(0), vec3(0.5f, 0, -0.3f), vec3(-2, 0, 1), vec3(3, 0, 3)}) {
    const double f = test::polygonFormFactor(x, vec3(0, 1, 0), light);
    const double expected = 0.6 * 7.0 * f;  // ρ/π · E, E = π L F
    EXPECT_NEAR(meanOf(renderReference(scene, viewOfFloor(x), 256, 0)).r / expected, 1.0, 4e-3)
        << x.x;
  }
}

// Two squares of side 2 at a distance of 1 m: the floor emits, the ceiling reflects, and the floor
// reflects the light that returns. At a point of the floor with bounces = 1, L = Le + ρ_floor ∫
// ρ_ceiling Le F(x') cos cos / (π r²) dA'.
TEST(ClosedForm, OneBounceBetweenTwoParallelPlates) {
  constexpr float kEmission = 4.0f, kFloor = 0.5f, kCeiling = 0.8f;
  Scene scene;
  const int floor = test::addMaterial(scene, vec3(kFloor), vec3(kEmission));
  const int ceiling = test::addMaterial(scene, vec3(kCeiling));
  test::addMesh(scene, test::squareMesh(2.0f, floor));
  const NodeId above = test::addMesh(scene, test::squareMesh(2.0f, ceiling), vec3(0, 1, 0));
  scene.find(above)->local.rotation = glm::angleAxis(kPi, vec3(1, 0, 0));

  const std::vector<vec3> floorSquare{{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  const vec3 x(0.25f, 0.0f, -0.4f);
  constexpr int n = 200;
  double gathered = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const vec3 p(-1.0f + 2.0f * (static_cast<float>(i) + 0.5f) / n, 1.0f,
                   -1.0f + 2.0f * (static_cast<float>(j) + 0.5f) / n);
      const vec3 d = p - x;
      const double r2 = static_cast<double>(glm::dot(d, d));
      const double kernel =
          1.0 / (static_cast<double>(kPi) * r2 * r2);  // cos = cos' = 1/r, height 1
      gathered += kCeiling * kEmission * test::polygonFormFactor(p, vec3(0, -1, 0), floorSquare) *
                  kernel * 4.0 / (n * n);
    }
  }
  // From the side, below the ceiling.
  const View view = lookAt(x + vec3(3.0f, 0.6f, 0.0f), x, 8, 8, 0.005f);
  const double measured =
      static_cast<double>(meanOf(renderReference(scene, view, 2048, 1)).r) - kEmission;
  EXPECT_NEAR(measured / (kFloor * gathered), 1.0, 6e-3);
}

TEST(ClosedForm, PunctualLightsGiveTheirIrradiance) {
  const auto radianceUnder = [](const PunctualLight& light, const vec3& at, const vec3& x) {
    Scene scene;
    const int material = test::addMaterial(scene, vec3(0.5f));
    test::addMesh(scene, test::squareMesh(20.0f, material));
    const NodeId id = test::addNode(scene, "light", kNoNode, at);
    scene.find(id)->local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));  // aims down
    scene.find(id)->punctual = light;
    return meanOf(renderReference(scene, viewOfFloor(x, 4), 4, 0)).r;
  };
  const float rhoOverPi = 0.5f / kPi;
  // Point: I cos θ / d²; 2 m above, 1.5 m to the side: d² = 6.25, cos θ = 0.8.
  EXPECT_NEAR(radianceUnder({PunctualKind::point, vec3(5.0f)}, vec3(0, 2, 0), vec3(1.5f, 0, 0)),
              rhoOverPi * 5.0f * 0.8f / 6.25f, 3e-5f);
  // Directional: E cos θ, θ = 0.
  EXPECT_NEAR(radianceUnder({PunctualKind::directional, vec3(5.0f)}, vec3(0, 2, 0), vec3(3, 0, 0)),
              rhoOverPi * 5.0f, 1e-5f);
  // Spot: between the cones ((cos θ − cos o)/(cos i − cos o))².
  PunctualLight spot{PunctualKind::spot, vec3(5.0f)};
  spot.innerCone = std::acos(0.9f);
  spot.outerCone = std::acos(0.7f);
  EXPECT_NEAR(radianceUnder(spot, vec3(0, 2, 0), vec3(0)), rhoOverPi * 5.0f / 4.0f, 1e-4f);
  EXPECT_NEAR(radianceUnder(spot, vec3(0, 2, 0), vec3(1.5f, 0, 0)),
              rhoOverPi * 5.0f * 0.25f * 0.8f / 6.25f, 5e-5f);
  EXPECT_EQ(radianceUnder(spot, vec3(0, 2, 0), vec3(4, 0, 0)), 0.0f);
}

}  // namespace
}  // namespace lamplighter
