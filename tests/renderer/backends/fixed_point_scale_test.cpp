#include "renderer/backends/cpu/irradiance/fixed_point_scale.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/scenes/random_boxes.h"

namespace lamplighter::cpu {
namespace {

std::vector<LightRecord> randomLights(uint32_t seed) {
  std::vector<LightRecord> lights;
  for (shared::Vpl vpl : test::randomVpls(60, seed)) {
    if (lights.size() % 4 == 0) vpl.position.w = shared::kVplUniform;
    lights.push_back(makeLightRecord(vpl, nullptr, 0));
  }
  return lights;
}

// Upper bound on the irradiance from all lights at a point that faces all of them [W/m²].
float irradianceBoundAt(const vec3& point, const std::vector<LightRecord>& lights,
                        float clampDistance) {
  float sum = 0.0f;
  for (const LightRecord& light : lights) {
    const vec3 way = point - light.position;
    const float d2 = glm::dot(way, way);
    const float least = light.kind == LightRecord::Kind::cosine
                            ? std::max(clampDistance * clampDistance, 1.0f / 4096.0f)
                            : 1.0f / 256.0f;
    sum +=
        std::max({light.intensity.r, light.intensity.g, light.intensity.b}) / std::max(d2, least);
  }
  return sum;
}

// A fixed-point sum must not overflow 32 bits at any point, including points near lights. With a
// small clamp distance the scale must be finer than the bound for a point that touches all lights
// at once.
TEST(FixedPointScale, IsFineEnoughAndNoSumOverflows) {
  for (const float clampDistance : {0.5f, 0.2f, 0.05f, 0.01f}) {
    for (uint32_t seed = 1; seed <= 5; ++seed) {
      const std::vector<LightRecord> lights = randomLights(seed);
      const float units = unitsPerIrradiance(lights, clampDistance * clampDistance);
      std::mt19937 random(seed);
      std::uniform_real_distribution<float> around(-3.0f, 3.0f), near(-0.1f, 0.1f);
      for (int i = 0; i < 2000; ++i) {
        vec3 point(around(random), around(random), around(random));
        if (i % 2 == 0)
          point = lights[static_cast<size_t>(i / 2) % lights.size()].position +
                  vec3(near(random), near(random), near(random));
        EXPECT_LE(units * irradianceBoundAt(point, lights, clampDistance), 0x1p30f);
      }
      float touched = 0.0f;
      for (const LightRecord& light : lights)
        touched += irradianceBoundAt(light.position, {light}, clampDistance);
      if (clampDistance < 0.1f) {
        EXPECT_GT(units * touched, 0x1p31f);
      }
    }
  }
}

// Only for many dim lights, because two parts take longer to sum.
TEST(FixedPointScale, SumsAreFineForManyDimLights) {
  const auto needFine = [](size_t dim, float brightness) {
    std::vector<LightRecord> lights = randomLights(1);
    for (size_t i = 0; i < dim; ++i) {
      lights.push_back(lights[0]);
      lights.back().intensity = vec3(brightness);
    }
    return needFineSums(lights, unitsPerIrradiance(lights, 0.25f));
  };
  EXPECT_FALSE(needFine(0, 0.0f));
  EXPECT_FALSE(needFine(500, 1.0f));
  EXPECT_TRUE(needFine(2000, 1.0f));
  EXPECT_FALSE(needFine(32, 1e-8f));
  EXPECT_TRUE(needFine(33, 1e-8f));
  EXPECT_FALSE(needFine(500, 0.0f));
}

}  // namespace
}  // namespace lamplighter::cpu
