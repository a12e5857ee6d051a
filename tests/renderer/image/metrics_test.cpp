#include "renderer/image/metrics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

TEST(Metrics, AreWhatTheFormulasSay) {
  Image a(2, 1), b(2, 1);
  a.at(0, 0) = vec3(1.0f);
  a.at(1, 0) = vec3(4.0f);
  b.at(0, 0) = vec3(2.0f);
  b.at(1, 0) = vec3(2.0f);
  const Metrics m = compareImages(a, b);
  EXPECT_NEAR(m.relRmse, std::sqrt((1.0 + 4.0) / 2.0) / 2.0, 1e-12);
  EXPECT_NEAR(m.relMse, (1.0 + 4.0) / 2.0 / (4.0 + 0.01), 1e-12);
  EXPECT_NEAR(m.bias, 1.25, 1e-12);
  EXPECT_EQ(m.max, 2.0);
  EXPECT_EQ(relRmse(a, b), m.relRmse);
}

TEST(Metrics, ThePictureItselfHasNoError) {
  Image a(20, 10);
  for (size_t i = 0; i < a.pixels.size(); ++i)
    a.pixels[i] = vec3(static_cast<float>(i % 7), 1.0f, 0.5f);
  const Metrics m = compareImages(a, a);
  EXPECT_EQ(m.relRmse, 0.0);
  EXPECT_EQ(m.bias, 1.0);
  EXPECT_EQ(m.max, 0.0);
  EXPECT_NEAR(m.ssim, 1.0, 1e-6);
}

TEST(Metrics, NoiseLowersSimilarity) {
  Image a(64, 64, vec3(0.2f)), little = a, much = a;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const float sign = (i * 2654435761u >> 16) & 1u ? 1.0f : -1.0f;
    little.pixels[i] += sign * 0.01f;
    much.pixels[i] += sign * 0.1f;
  }
  EXPECT_GT(compareImages(little, a).ssim, compareImages(much, a).ssim);
  EXPECT_LT(compareImages(much, a).ssim, 0.5);
}

// Uniform pictures of radiance 1 and 0.18, tone-mapped to x = 0.90823 and y = 0.55346. Without
// variance the index is (2xy + 0.01²) / (x² + y² + 0.01²).
TEST(Metrics, SimilarityOfUniformPicturesDependsOnLuminance) {
  EXPECT_NEAR(compareImages(Image(16, 12, vec3(1.0f)), Image(16, 12, vec3(0.18f))).ssim, 0.88874,
              1e-3);
}

TEST(Metrics, SimilarityUsesOnlyMaskedPixels) {
  Image a(64, 8, vec3(0.3f)), b = a, mask(64, 8);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 16; ++x) a.at(x, y) = vec3(x % 2 == 0 ? 0.0f : 1.0f);
    for (int x = 32; x < 64; ++x)
      mask.at(x, y) = vec3(1.0f);  // no window of these pixels reaches the noise
  }
  EXPECT_LT(compareImages(a, b).ssim, 0.9);
  EXPECT_NEAR(compareImages(a, b, &mask).ssim, 1.0, 1e-4);
}

TEST(Metrics, NanMakesEveryMeanNan) {
  Image a(4, 4, vec3(1.0f)), b = a;
  a.at(2, 2).g = std::numeric_limits<float>::quiet_NaN();
  const Metrics m = compareImages(a, b);
  EXPECT_TRUE(std::isnan(m.relRmse) && std::isnan(m.relMse) && std::isnan(m.bias) &&
              std::isnan(m.max) && std::isnan(m.ssim));
}

TEST(Metrics, OnlyMaskedPixelsCount) {
  Image a(2, 1, vec3(1.0f)), b = a, mask(2, 1);
  a.at(0, 0) = vec3(9.0f);
  mask.at(1, 0) = vec3(1.0f);
  EXPECT_EQ(compareImages(a, b, &mask).relRmse, 0.0);
  EXPECT_THROW(compareImages(a, b, std::make_unique<Image>(2, 1).get()), InputError);
}

TEST(HeatMap, GrowsFromBlackToWhiteWithTheError) {
  const int n = 201;
  Image a(n, 1), b(n, 1, vec3(2.0f));
  for (int x = 0; x < n; ++x) a.at(x, 0) = b.at(x, 0) + 2.0f * static_cast<float>(x) / (n - 1);
  const Image8 map = heatMap(a, b);
  double last = -1.0;
  for (int x = 0; x < n; ++x) {
    const uint8_t* p = map.at(x, 0);
    const double luma = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
    EXPECT_GE(luma, last) << x;
    last = luma;
  }
  EXPECT_EQ(map.at(0, 0)[0] + map.at(0, 0)[1] + map.at(0, 0)[2], 0);
  EXPECT_EQ(map.at(n - 1, 0)[0] + map.at(n - 1, 0)[1] + map.at(n - 1, 0)[2], 3 * 255);
}

TEST(HeatMap, MarksNanPixels) {
  Image a(2, 1, vec3(1.0f)), b = a;
  a.at(1, 0).g = std::numeric_limits<float>::quiet_NaN();
  const Image8 map = heatMap(a, b);
  EXPECT_EQ(map.at(0, 0)[0], 0);
  EXPECT_EQ(map.at(1, 0)[0], 255);
  EXPECT_EQ(map.at(1, 0)[1], 0);  // magenta does not occur in the colour scale
  EXPECT_EQ(map.at(1, 0)[2], 255);
}

TEST(Metrics, SizesMustAgree) { EXPECT_THROW(compareImages(Image(2, 1), Image(1, 2)), InputError); }

}  // namespace
}  // namespace lamplighter
