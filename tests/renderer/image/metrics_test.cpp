#include "renderer/image/metrics.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/error.h"

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
}

TEST(Metrics, ThePictureItselfIsPerfect) {
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

TEST(Metrics, NanPoisonsEveryMean) {
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

TEST(Metrics, SizesMustAgree) { EXPECT_THROW(compareImages(Image(2, 1), Image(1, 2)), InputError); }

}  // namespace
}  // namespace lamplighter
