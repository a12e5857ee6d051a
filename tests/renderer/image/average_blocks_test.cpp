#include "renderer/image/average_blocks.h"

#include <limits>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

Image numbered(int width, int height) {
  Image image(width, height);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = vec3(static_cast<float>(i), 1.0f, 2.0f);
  return image;
}

TEST(AverageBlocks, OfWholeBlocks) {
  const Image blocks = averageBlocks(numbered(5, 4), 2);
  ASSERT_EQ(blocks.width, 2);
  ASSERT_EQ(blocks.height, 2);
  EXPECT_EQ(blocks.at(1, 1), vec3(15.0f, 1.0f, 2.0f));  // of 12, 13, 17, 18
}

TEST(AverageBlocks, OfTheMaskAlone) {
  Image picture = numbered(4, 2), mask(4, 2);
  mask.at(1, 0) = mask.at(2, 0) = mask.at(2, 1) = vec3(1.0f);
  picture.at(0, 0) = vec3(std::numeric_limits<float>::infinity());
  const Image blocks = averageBlocks(picture, 2, &mask);
  EXPECT_EQ(blocks.at(0, 0), vec3(1.0f, 1.0f, 2.0f));
  EXPECT_EQ(blocks.at(1, 0), vec3(4.0f, 1.0f, 2.0f));  // of 2 and 6
  const Image counts = blockMask(mask, 2);
  EXPECT_EQ(counts.at(0, 0).r, 0.0f);  // one of four
  EXPECT_EQ(counts.at(1, 0).r, 1.0f);
}

TEST(AverageBlocks, ABlockOfOnePixelIsThePicture) {
  const Image picture = numbered(3, 2);
  EXPECT_EQ(averageBlocks(picture, 1, nullptr).pixels, picture.pixels);
}

}  // namespace
}  // namespace lamplighter
