#include "renderer/image/histogram.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

int binOf(float stops) {
  return static_cast<int>((stops - Histogram::kLowest) * Histogram::kBins /
                          (Histogram::kHighest - Histogram::kLowest));
}

TEST(HistogramTest, CountsEachPixelInTheBinOfItsExposedLuminance) {
  Image image(10, 10, vec3(1.0f));
  for (int x = 0; x < 10; ++x) image.at(x, 0) = vec3(0.25f * 1.01f);
  image.at(0, 1) = vec3(0.0f, 1.0f / 0.7152f * 1.01f, 0.0f);  // luminance 1 of green alone
  const Histogram h = histogramOf(image, -1.0f, ToneMapper::linear);
  EXPECT_EQ(h.pixels, 100u);
  EXPECT_EQ(std::accumulate(h.bins.begin(), h.bins.end(), uint64_t{0}), 100u);
  EXPECT_EQ(h.bins[static_cast<size_t>(binOf(-2.99f))], 10u);
  EXPECT_EQ(h.bins[static_cast<size_t>(binOf(-0.95f))], 90u);
  EXPECT_NEAR(std::log2(h.median), 0.0f, 0.1f);  // of the radiance before exposure
}

TEST(HistogramTest, CountsClippedPixels) {
  Image image(10, 10, vec3(0.5f));
  for (int x = 0; x < 10; ++x)
    image.at(x, 0) = vec3(0.1f, 3.0f, 0.1f);  // one clipped channel counts
  for (int x = 0; x < 5; ++x) image.at(x, 1) = vec3(0.0f);
  image.at(9, 9) = vec3(std::numeric_limits<float>::quiet_NaN());
  image.at(8, 9) = vec3(std::numeric_limits<float>::infinity());
  const Histogram linear = histogramOf(image, 0.0f, ToneMapper::linear);
  EXPECT_FLOAT_EQ(linear.white, 0.11f);
  EXPECT_FLOAT_EQ(linear.black, 0.06f);
  EXPECT_EQ(linear.bins.back(), 1u);
  // The white point of `reinhard` is 4.
  EXPECT_FLOAT_EQ(histogramOf(image, 0.0f, ToneMapper::reinhard).white, 0.01f);
  EXPECT_FLOAT_EQ(histogramOf(image, 1.0f, ToneMapper::reinhard).white, 0.11f);
  // The counts equal those of the displayed picture.
  const Image8 shown = toneMap(image, 0.0f, ToneMapper::linear);
  int whites = 0;
  for (size_t i = 0; i < image.pixels.size(); ++i)
    whites += shown.pixels[4 * i] == 255 || shown.pixels[4 * i + 1] == 255 ||
              shown.pixels[4 * i + 2] == 255;
  EXPECT_EQ(whites, 11);
}

TEST(HistogramTest, AnEmptyAndABlackPictureHaveNoMedian) {
  EXPECT_EQ(histogramOf(Image(), 0.0f, ToneMapper::agx).pixels, 0u);
  const Histogram black = histogramOf(Image(4, 4), 0.0f, ToneMapper::agx);
  EXPECT_EQ(black.median, 0.0f);
  EXPECT_EQ(black.black, 1.0f);
  EXPECT_EQ(black.bins.front(), 16u);
}

}  // namespace
}  // namespace lamplighter
