// Which emitting surface a path samples: by place.
#include "renderer/sampling/emitters/emitter_choice.h"

#include <gtest/gtest.h>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "tests/support/render.h"
#include "tests/support/scenes/lit_scene.h"
#include "tests/support/scenes/scenes.h"

namespace lamplighter {
namespace {

// A long hall under a row of equal lamps.
struct Hall : testing::Test {
  static constexpr int kLamps = 24;
  Scene scene;

  Hall() {
    const int white = test::addMaterial(scene, vec3(0.7f));
    test::addMesh(scene, test::roomMesh(vec3(48.0f, 3.0f, 4.0f), white), vec3(0, 1.5f, 0));
    for (int i = 0; i < kLamps; ++i)
      test::addRectangleLight(scene, vec3(2.0f * static_cast<float>(i) - 23.0f, 2.9f, 0.0f),
                              vec2(0.3f), vec3(10.0f));
  }
};

TEST_F(Hall, ProbabilitiesAreThoseOfTheChoice) {
  const RenderScene world = test::renderSceneOf(scene);
  const LightSet lights = LightSet::forPaths(world);
  for (const vec3& place : {vec3(-23, 0, 0), vec3(0.3f, 1, 1), vec3(99, 99, 99)}) {
    double sum = 0.0;
    std::vector<int> chosen(lights.emitters().size(), 0);
    constexpr int kTries = 1 << 16;
    for (int k = 0; k < kTries; ++k) {
      float probability = 0.0f;
      const int e =
          lights.chooseSurface(place, (static_cast<float>(k) + 0.5f) / kTries, probability);
      EXPECT_EQ(probability, lights.surfaceProbability(place, e));
      ++chosen[static_cast<size_t>(e)];
    }
    for (size_t e = 0; e < chosen.size(); ++e) {
      const float p = lights.surfaceProbability(place, static_cast<int>(e));
      EXPECT_GT(p, 0.0f);
      EXPECT_NEAR(static_cast<double>(chosen[e]) / kTries, static_cast<double>(p), 2e-5);
      sum += static_cast<double>(p);
    }
    EXPECT_NEAR(sum, 1.0, 1e-5);
  }
}

TEST_F(Hall, NearLampsArePreferred) {
  const RenderScene world = test::renderSceneOf(scene);
  const LightSet lights = LightSet::forPaths(world), byFlux(world);
  const auto ofFirst = [&](const LightSet& l, float x) {
    return l.surfaceProbability(vec3(x, 0.5f, 0), l.emitterOfObject(1));
  };
  EXPECT_NEAR(ofFirst(byFlux, -23.0f), 1.0f / kLamps, 1e-4f);
  EXPECT_GT(ofFirst(lights, -23.0f), 5.0f / kLamps);
  EXPECT_LT(ofFirst(lights, 23.0f), 0.5f / kLamps);
}

TEST_F(Hall, LampsWithoutFluxAreNotChosen) {
  scene.find(scene.nodes.back().id)->area->radiance = vec3(0.0f);
  const RenderScene world = test::renderSceneOf(scene);
  const LightSet lights = LightSet::forPaths(world);
  for (int k = 0; k < 1000; ++k) {
    float probability = 0.0f;
    const int e = lights.chooseSurface(vec3(23, 0, 0), static_cast<float>(k) / 1000, probability);
    EXPECT_GT(luminance(lights.emitters()[static_cast<size_t>(e)].flux), 0.0f);
  }
}

// The same mean, and less noise: expected a quarter of the variance, because six lamps of 24 are
// near.
TEST_F(Hall, PathsHaveLessNoise) {
  const test::LitScene lit(scene);
  const View view = test::lookAt(vec3(-20, 2.5f, 0.5f), vec3(-19, 0, 0), 16, 12, 0.8f);
  PathTracerOptions options;
  options.bounces = 0;
  const auto statistics = [&](const LightSet& lights) {
    double sum = 0.0, squares = 0.0;
    constexpr uint32_t kSamples = 256;
    for (int y = 0; y < view.height; ++y)
      for (int x = 0; x < view.width; ++x) {
        double own = 0.0;
        for (uint32_t s = 0; s < kSamples; ++s) {
          const auto v = static_cast<double>(
              tracePath(lit.render, *lit.rays, lights, view, x, y, s, options).x);
          own += v;
          squares += v * v;
        }
        squares -= own * own / kSamples;
        sum += own;
      }
    return std::pair(sum, squares);
  };
  const auto [flux, noiseByFlux] = statistics(LightSet(lit.render));
  const auto [place, noiseByPlace] = statistics(LightSet::forPaths(lit.render));
  EXPECT_NEAR(place / flux, 1.0, 0.01);
  RecordProperty("variance", std::to_string(noiseByPlace / noiseByFlux));
  EXPECT_LT(noiseByPlace, 0.35 * noiseByFlux);
}

}  // namespace
}  // namespace lamplighter
