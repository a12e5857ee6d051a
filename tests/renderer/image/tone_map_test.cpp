// The tone curves: published values, monotonicity, and properties that all of them must have.
#include "renderer/image/tone_map.h"

#include <limits>

#include <gtest/gtest.h>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

TEST(ToneMappers, AreFoundByNameAndNoOther) {
  for (const ToneMapperInfo& m : toneMappers()) {
    EXPECT_EQ(findToneMapper(m.name).mapper, m.mapper);
    EXPECT_EQ(std::string(infoOf(m.mapper).name), m.name);
  }
  try {
    findToneMapper("none");
    FAIL();
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("linear, reinhard, filmic"), std::string::npos)
        << e.what();
  }
}

TEST(ToneMappers, HaveTheirPublishedValues) {
  const auto grey = [](float x, ToneMapper m) { return toneMapPixel(vec3(x), 0.0f, m).g; };
  EXPECT_NEAR(grey(0.18f, ToneMapper::linear), encodeSrgb(0.18f), 1e-6f);
  EXPECT_EQ(grey(1.0f, ToneMapper::linear), 1.0f);
  // x (1 + x/16) / (1 + x)
  EXPECT_NEAR(grey(1.0f, ToneMapper::reinhard), encodeSrgb(1.0625f / 2.0f), 1e-5f);
  EXPECT_NEAR(grey(4.0f, ToneMapper::reinhard), 1.0f, 1e-5f);
  EXPECT_NEAR(grey(5.6f, ToneMapper::hable), 1.0f,
              1e-5f);  // its white point is 11.2, twice this value
  EXPECT_LT(grey(5.0f, ToneMapper::hable), 1.0f);
  // Grey stays grey. Middle grey is displayed near the middle.
  const vec3 agx = toneMapPixel(vec3(0.18f), 0.0f, ToneMapper::agx);
  EXPECT_NEAR(agx.r, agx.g, 2e-3f);
  EXPECT_NEAR(agx.g, agx.b, 2e-3f);
  EXPECT_NEAR(agx.g, std::pow(0.18f, 1.0f / 2.4f), 0.015f);  // the pivot of its sigmoid
}

TEST(ToneMappers, ReinhardKeepsHues) {
  const vec3 shown = toneMapPixel(vec3(0.4f, 0.2f, 0.1f), 1.0f, ToneMapper::reinhard);
  const vec3 brighter = toneMapPixel(vec3(0.4f, 0.2f, 0.1f), 2.0f, ToneMapper::reinhard);
  const auto linear = [](float v) { return std::pow((v + 0.055f) / 1.055f, 2.4f); };
  EXPECT_NEAR(linear(shown.r) / linear(shown.b), 4.0f, 0.02f);
  EXPECT_NEAR(linear(brighter.r) / linear(brighter.g), 2.0f, 0.01f);
}

class EachMapper : public testing::TestWithParam<ToneMapper> {};

TEST_P(EachMapper, RisesFromBlackToWhiteAndNeverLeavesTheDisplay) {
  const ToneMapper m = GetParam();
  EXPECT_LT(toneMapPixel(vec3(0.0f), 0.0f, m).g, 0.5f / 255.0f);
  float before = -1.0f;
  for (float ev = -16.0f; ev < 13.0f; ev += 0.125f) {
    const vec3 shown = toneMapPixel(vec3(1.0f), ev, m);
    EXPECT_GE(shown.g, before - 2e-3f)
        << ev;  // fitted curves may ripple by less than one step of 8 bits
    before = shown.g;
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(shown[c], 0.0f);
      EXPECT_LE(shown[c], 1.0f);
    }
  }
  EXPECT_GT(before, 0.97f);
}

TEST_P(EachMapper, ShowsInfinityWhiteAndNanBlack) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const vec3 odd(kInfinity, std::numeric_limits<float>::quiet_NaN(), -1.0f);
  const vec3 shown = toneMapPixel(odd, 0.0f, GetParam());
  EXPECT_EQ(shown.r, 1.0f);
  EXPECT_EQ(shown.g, 0.0f);
  EXPECT_GE(shown.b, 0.0f);
  EXPECT_EQ(toneMapPixel(vec3(0.25f), 2.0f, GetParam()),
            toneMapPixel(vec3(1.0f), 0.0f, GetParam()));
}

INSTANTIATE_TEST_SUITE_P(All, EachMapper,
                         testing::Values(ToneMapper::linear, ToneMapper::reinhard,
                                         ToneMapper::filmic, ToneMapper::hable, ToneMapper::agx));

}  // namespace
}  // namespace lamplighter
