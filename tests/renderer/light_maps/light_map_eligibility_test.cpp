#include "renderer/light_maps/light_map_eligibility.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/random_boxes.h"

namespace lamplighter {
namespace {

constexpr float kClamp = 0.5f;

// The test of eight lights at a time equals the test of each light. Lights of every kind are far
// from the tile, near it, in its plane, behind it, and too bright.
TEST(EligibleLights, EqualTheTestOfEachLight) {
  std::vector<shared::Vpl> lights = test::randomVpls(180, 7);
  for (size_t i = 0; i < lights.size(); ++i) {
    if (i % 5 == 0) lights[i].position.y = 0.3f;  // the plane of the tile
    if (i % 7 == 0) lights[i].intensity *= 1e5f;
    if (i % 11 == 0) lights[i].position.w = shared::kVplUniform;
    if (i % 11 == 0)
      lights[i].normal.w = i % 2 == 0 ? 0.0f : 4.0f;  // an omnidirectional light or a spot light
  }
  shared::Vpl sun = test::makeVpl(vec3(0), vec3(0.5f, 1, 0.4f), shared::kVplDirectional, 2.0f);
  sun.normal.w = 5.0f;
  sun.tangent.w = 9.0f;
  lights.push_back(sun);
  std::vector<uint32_t> slots;
  for (uint32_t i = 0; i < lights.size(); ++i)
    if (i % 3 != 0 || i + 1 == lights.size()) slots.push_back(i);
  Chart chart;
  chart.origin = vec3(0.2f, 0.3f, -0.1f);
  chart.tangent = vec3(1, 0, 0);
  chart.bitangent = vec3(0, 0, -1);
  chart.normal = vec3(0, 1, 0);
  const EligibleLights many(lights, slots, kClamp);
  int eligible = 0, tiles = 0;
  for (float at = -3.0f; at < 3.0f; at += 0.4f, ++tiles) {
    Patch patch;
    patch.min = vec2(at, 0.5f * at);
    patch.max = patch.min + vec2(0.4f, 0.2f);
    const TilePlace tile(chart, patch, 0.02f);
    std::vector<uint64_t> bits(3, ~uint64_t{0});
    many.find(tile, bits);
    for (uint32_t i = 0; i < lights.size(); ++i) {
      const bool isAsked = std::find(slots.begin(), slots.end(), i) != slots.end();
      const bool expected = !isAsked || isLightMapEligible(lights[i], tile, kClamp);
      EXPECT_EQ((bits[i / 64] >> i % 64 & 1) != 0, expected) << i << ", " << at;
      eligible += isAsked && expected;
    }
  }
  EXPECT_GT(eligible, tiles * 20);
  EXPECT_LT(eligible, tiles * static_cast<int>(slots.size() - 20));
}

}  // namespace
}  // namespace lamplighter
