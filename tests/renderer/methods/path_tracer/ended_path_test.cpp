// Paths that end at known light: whatever that light is, the sum with what it lacks is the whole
// path.
#include <gtest/gtest.h>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"
#include "tests/support/scenes/small_room.h"

namespace lamplighter {
namespace {

// The same everywhere, known as finely as `least` [m²].
class EvenLight final : public KnownLight {
 public:
  EvenLight(float radiance, float least) : radiance_(radiance), least_(least) {}
  std::optional<vec3> reflectedAt(const Ray&, const Hit&, float spread) const override {
    if (spread < least_) return std::nullopt;
    return vec3(radiance_);
  }

 private:
  float radiance_, least_;
};

struct EndedPaths : testing::Test, test::SmallRoom {
  test::LitScene lit{scene};
  const LightSet lights{lit.render};
  PathTracerOptions options;

  EndedPaths() { options.bounces = 3; }
  vec3 whole(int x, int y, uint32_t sample, uint64_t* traced = nullptr) const {
    return tracePath(lit.render, *lit.rays, lights, view, x, y, sample, options, traced);
  }
  EndedPath ended(const EvenLight& light, int x, int y, uint32_t sample, bool isWhole,
                  uint64_t* traced = nullptr) const {
    return traceEndedPath(lit.render, *lit.rays, lights, view, x, y, sample, options, light,
                          isWhole, traced);
  }
};

TEST_F(EndedPaths, WhatIsMissingMakesThePathWhole) {
  for (const float radiance : {0.0f, 0.5f, 10.0f})
    for (const float least : {0.0f, 0.5f}) {
      const EvenLight light(radiance, least);
      for (int y = 0; y < view.height; y += 5)
        for (int x = 0; x < view.width; x += 5) {
          const EndedPath both = ended(light, x, y, 3, true);
          const vec3 path = whole(x, y, 3);
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(both.radiance[c] + both.missing[c], path[c], 1e-4f * (1.0f + path[c]));
          const EndedPath alone = ended(light, x, y, 3, false);
          EXPECT_EQ(alone.radiance, both.radiance);
          EXPECT_EQ(alone.missing, vec3(0.0f));
        }
    }
}

TEST_F(EndedPaths, HaveTheBitsOfThePathWhereNothingIsKnown) {
  const EvenLight light(1.0f, std::numeric_limits<float>::infinity());
  for (int x = 0; x < view.width; ++x) {
    const EndedPath path = ended(light, x, 30, 5, true);
    EXPECT_EQ(path.radiance, whole(x, 30, 5));
    EXPECT_EQ(path.missing, vec3(0.0f));
  }
}

// A ray from the camera, one to the lamp, one to where light is known.
TEST_F(EndedPaths, TraceThreeRays) {
  const EvenLight light(1.0f, 0.0f);
  uint64_t few = 0, all = 0;
  constexpr int kRow = 40;
  for (int x = 0; x < view.width; ++x) {
    ended(light, x, kRow, 1, false, &few);
    whole(x, kRow, 1, &all);
  }
  EXPECT_LE(few, 3u * static_cast<unsigned>(view.width));
  EXPECT_LT(2 * few, all);
}

// In a corner paths spread little, so they go on; far from it they end.
TEST_F(EndedPaths, GoOnWhereTheySpreadLittle) {
  uint64_t fine = 0, coarse = 0;
  for (int x = 0; x < view.width; ++x)
    for (uint32_t sample = 0; sample < 16; ++sample) {
      ended(EvenLight(1.0f, 0.01f), x, 24, sample, false, &fine);
      ended(EvenLight(1.0f, 16.0f), x, 24, sample, false, &coarse);
    }
  EXPECT_GT(coarse, fine + fine / 10);
}

}  // namespace
}  // namespace lamplighter
