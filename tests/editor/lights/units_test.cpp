// Units and colour temperatures, compared with closed forms and published values.
#include <gtest/gtest.h>

#include "editor/lights/colour_temperature.h"
#include "editor/lights/light_list.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

constexpr double kPiD = 3.14159265358979323846;

struct Lamp {
  Scene scene;
  Lamp(AreaShape shape, vec2 size, vec3 scale = vec3(1.0f)) {
    const NodeId id = test::addNode(scene, "lamp");
    scene.find(id)->area = AreaLight{shape, vec3(2.0f), size};
    scene.find(id)->local.scale = scale;
  }
  explicit Lamp(const PunctualLight& light) {
    scene.find(test::addNode(scene, "lamp"))->punctual = light;
  }
  double in(LightUnit unit) const { return unitsPerRadiance(lightsOf(scene).at(0).measure, unit); }
};

TEST(LightUnits, AreaLightsUseTheirArea) {
  const Lamp square(AreaShape::rectangle, {2.0f, 0.5f});
  EXPECT_NEAR(square.in(LightUnit::nits), 1.0, 1e-6);
  EXPECT_NEAR(square.in(LightUnit::lumens), kPiD, 1e-5);  // Φ = π L A of a Lambertian emitter
  EXPECT_NEAR(square.in(LightUnit::candela), 1.0, 1e-6);  // L A on its axis
  EXPECT_NEAR(square.in(LightUnit::watts), kPiD / 683.0, 1e-8);
  const Lamp disk(AreaShape::disk, vec2(2.0f));
  EXPECT_NEAR(disk.in(LightUnit::lumens), kPiD * kPiD, 1e-4);
  const Lamp ball(AreaShape::sphere, vec2(2.0f));
  EXPECT_NEAR(ball.in(LightUnit::lumens), 4.0 * kPiD * kPiD, 1e-4);
  EXPECT_NEAR(ball.in(LightUnit::candela), kPiD, 1e-5);  // its disk seen from anywhere: Φ / 4π
  const Lamp tube(AreaShape::tube, {3.0f, 0.2f});
  EXPECT_NEAR(tube.in(LightUnit::lumens), kPiD * kPiD * 0.2 * 3.0, 1e-4);
  EXPECT_NEAR(tube.in(LightUnit::candela), 0.6, 1e-6);  // length × diameter
}

TEST(LightUnits, IncludeTheScaleOfTheNode) {
  EXPECT_NEAR(Lamp(AreaShape::rectangle, {1, 1}, {2, 3, 7}).in(LightUnit::candela), 6.0, 1e-5);
  EXPECT_NEAR(Lamp(AreaShape::tube, {1, 1}, {2, 3, 3}).in(LightUnit::candela), 6.0, 1e-5);
}

TEST(LightUnits, PunctualLightsUseTheirSolidAngle) {
  const Lamp point({PunctualKind::point, vec3(1)});
  EXPECT_NEAR(point.in(LightUnit::candela), 1.0, 1e-9);
  EXPECT_NEAR(point.in(LightUnit::lumens), 4.0 * kPiD, 1e-6);
  EXPECT_EQ(point.in(LightUnit::nits), 0.0);
  // Without falloff between the cones, the solid angle is that of a cap: 2π (1 − cos).
  PunctualLight spot{PunctualKind::spot, vec3(1)};
  spot.innerCone = spot.outerCone = 0.5f;
  EXPECT_NEAR(Lamp(spot).in(LightUnit::lumens), 2.0 * kPiD * (1.0 - std::cos(0.5)), 1e-6);
  spot.innerCone = 0.0f;  // the squared linear falloff has the mean 1/3
  EXPECT_NEAR(Lamp(spot).in(LightUnit::lumens), 2.0 / 3.0 * kPiD * (1.0 - std::cos(0.5)), 1e-6);
  const Lamp sun({PunctualKind::directional, vec3(1)});
  EXPECT_EQ(sun.in(LightUnit::lux), 1.0);
  EXPECT_EQ(sun.in(LightUnit::lumens), 0.0);
  EXPECT_EQ(unitFor({LightKind::sun}, LightUnit::watts), LightUnit::lux);
  EXPECT_EQ(unitFor({LightKind::sky}, LightUnit::lumens), LightUnit::nits);
}

TEST(LightUnits, MeshesUseBothSides) {
  for (const bool bothSides : {false, true}) {
    Scene scene;
    const int glow = test::addMaterial(scene, vec3(0), vec3(3));
    scene.materials[static_cast<size_t>(glow)].doubleSided = bothSides;
    test::addMesh(scene, test::squareMesh(2.0f, glow));
    const auto lights = lightsOf(scene);
    ASSERT_EQ(lights.size(), 1u);
    EXPECT_EQ(lights[0].measure.kind, LightKind::mesh);
    EXPECT_NEAR(unitsPerRadiance(lights[0].measure, LightUnit::lumens),
                kPiD * 4.0 * (bothSides ? 2 : 1), 1e-5);
    EXPECT_EQ(emissionOf(scene, lights[0]), vec3(3));
  }
}

TEST(LightUnits, HaveNames) {
  EXPECT_EQ(unitNamed("nits"), LightUnit::nits);
  EXPECT_EQ(unitNamed("lm"), LightUnit::lumens);
  EXPECT_EQ(unitNamed("LM"), std::nullopt);
}

vec2 chromaticity(const vec3& rgb) {
  const mat3 xyzFromRgb(0.4124564f, 0.2126729f, 0.0193339f, 0.3575761f, 0.7151522f, 0.1191920f,
                        0.1804375f, 0.0721750f, 0.9503041f);
  const vec3 xyz = xyzFromRgb * rgb;
  return vec2(xyz) / (xyz.x + xyz.y + xyz.z);
}

// CIE 15: standard illuminant A is a black body of 2856 K (2848 K on the scale of its time).
TEST(ColourTemperature, KnownPointsOfThePlanckianLocus) {
  const vec2 a = chromaticity(planckianColour(2856.0f));
  EXPECT_NEAR(a.x, 0.4476f, 5e-4f);
  EXPECT_NEAR(a.y, 0.4075f, 5e-4f);
  const vec2 day = chromaticity(planckianColour(6500.0f));
  EXPECT_NEAR(day.x, 0.3135f, 1e-3f);
  EXPECT_NEAR(day.y, 0.3237f, 1e-3f);
  EXPECT_NEAR(luminance(planckianColour(1200.0f)), 1.0f, 1e-5f);
  EXPECT_EQ(planckianColour(1200.0f).b, 0.0f);  // outside of the gamut
}

TEST(ColourTemperature, RoundTrip) {
  for (const float kelvin : {1100.0f, 1900.0f, 2700.0f, 4000.0f, 6500.0f, 12000.0f}) {
    const auto back = temperatureOf(7.0f * planckianColour(kelvin));
    ASSERT_TRUE(back) << kelvin;
    EXPECT_NEAR(*back, kelvin, 0.002f * kelvin);
  }
  EXPECT_NEAR(*temperatureOf(vec3(1.0f)), 6504.0f, 60.0f);  // D65 is close to the locus
  EXPECT_FALSE(temperatureOf(vec3(0, 1, 0)));
  EXPECT_FALSE(temperatureOf(vec3(0)));
  const vec3 warm = withTemperature(vec3(0.2f, 0.4f, 0.9f), 2700.0f);
  EXPECT_NEAR(luminance(warm), luminance(vec3(0.2f, 0.4f, 0.9f)), 1e-5f);
}

}  // namespace
}  // namespace lamplighter
