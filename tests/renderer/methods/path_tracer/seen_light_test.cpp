// Light that the camera sees itself, by rays: with paths that leave it out it is the whole picture.
#include "renderer/methods/path_tracer/seen_light.h"

#include <gtest/gtest.h>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

struct LightTheCameraSees : testing::Test, test::SmallRoom {
  // The lamp from below, against the ceiling: with edges within pixels.
  LightTheCameraSees() {
    view = test::lookAt(vec3(0.4f, 1.0f, 0.5f), vec3(0.2f, 2.2f, 0.1f), 12, 8, 1.2f);
    options.bounces = 1;
  }
  PathTracerOptions options;
};

TEST_F(LightTheCameraSees, AddUpToTheWholePicture) {
  constexpr uint32_t kSamples = 512;
  const test::LitScene lit(scene);
  const LightSet lights(lit.render);
  PathTracerOptions without = options;
  without.seesLights = false;
  int mixed = 0, alone = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      vec3 whole(0.0f), parts(0.0f);
      bool isMixed = false;
      for (uint32_t s = 0; s < kSamples; ++s) {
        const SeenLight seen = seenLight(lit.render, *lit.rays, lights, view, x, y, s, 5);
        isMixed = isMixed || (seen.isMixed && seen.radiance != vec3(0.0f));
        without.inPixel = seen.onSurface;
        parts += seen.radiance +
                 seen.surfaces * tracePath(lit.render, *lit.rays, lights, view, x, y, s, without);
        whole += tracePath(lit.render, *lit.rays, lights, view, x, y, s, options);
        if (!seen.isMixed) ++alone;
      }
      mixed += isMixed;
      const float most = std::max(whole.x, parts.x) / kSamples;
      EXPECT_NEAR(whole.x / kSamples, parts.x / kSamples, 0.05f * most + 0.02f) << x << ' ' << y;
    }
  EXPECT_GT(mixed, 4);
  EXPECT_GT(alone, 0);
}

TEST_F(LightTheCameraSees, TheSkyIsSeenToo) {
  Scene outside;
  outside.sky = vec3(2.0f, 3.0f, 4.0f);
  const test::LitScene lit(outside);
  const SeenLight seen = seenLight(lit.render, *lit.rays, LightSet(lit.render), view, 3, 3, 0, 1);
  EXPECT_EQ(seen.radiance, vec3(2.0f, 3.0f, 4.0f));
  EXPECT_EQ(seen.surfaces, 0.0f);
  EXPECT_FALSE(seen.isMixed);
}

// Between the sky and a surface as bright as the sky there is no edge to see, nor any noise.
TEST_F(LightTheCameraSees, SharesOfAPixelAddUp) {
  Scene ground;
  test::addMesh(ground, test::boxMesh(vec3(1.0f), test::addMaterial(ground, vec3(1.0f))));
  ground.sky = vec3(1.0f);
  view = test::lookAt(vec3(0, 0, 4), vec3(0), 24, 16, 0.4f);
  const test::LitScene lit(ground);
  const LightSet lights(lit.render);
  int edges = 0;
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x) {
      const SeenLight seen = seenLight(lit.render, *lit.rays, lights, view, x, y, 0, 1);
      EXPECT_NEAR(seen.radiance.x + seen.surfaces, 1.0f, 1e-6f);
      edges += seen.radiance.x > 0.0f && seen.surfaces > 0.0f;
    }
  EXPECT_GT(edges, 0);
}

}  // namespace
}  // namespace lamplighter
