#include "ui/app/picture_check.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

Image8 grey(int width, int height) {
  Image8 image(width, height);
  std::fill(image.pixels.begin(), image.pixels.end(), uint8_t{100});
  return image;
}

TEST(PictureCheck, EqualPicturesDoNotDiffer) {
  const PictureDifference d = comparePictures(grey(40, 50), grey(40, 50));
  EXPECT_TRUE(d.none());
  EXPECT_EQ(d.largest, 0);
  EXPECT_TRUE(d.within(0.0, 0.0));
}

TEST(PictureCheck, HalvingAveragesFourPixelsAndFewerAtTheBorder) {
  Image8 image = grey(5, 3);
  image.at(0, 0)[0] = 104;
  image.at(4, 2)[1] = 50;
  const Image8 half = halved(image);
  EXPECT_EQ(half.width, 3);
  EXPECT_EQ(half.height, 2);
  EXPECT_EQ(half.at(0, 0)[0], 101);
  EXPECT_EQ(half.at(1, 0)[0], 100);
  EXPECT_EQ(half.at(2, 1)[1], 50);
}

// Silhouettes may differ by more: of 2,000 pixels, the two with the largest differences are
// ignored.
TEST(PictureCheck, IgnoresOnePixelInAThousand) {
  Image8 a = grey(40, 50);
  a.at(3, 4)[0] = 250;
  a.at(7, 9)[2] = 0;
  for (int x = 0; x < 40; ++x) a.at(x, 20)[1] = 105;
  PictureDifference d = comparePictures(a, grey(40, 50));
  EXPECT_EQ(d.pixels, 42u);
  EXPECT_EQ(d.max, 150);
  EXPECT_EQ(d.largest, 5);
  EXPECT_NEAR(d.mean, (150.0 + 100.0 + 40 * 5) / 6000.0, 1e-9);
  EXPECT_TRUE(d.within(5.0, 0.1));
  EXPECT_FALSE(d.within(4.0, 0.1));
  EXPECT_FALSE(d.within(5.0, 0.05));
  a.at(30, 40)[1] = 200;
  EXPECT_EQ(comparePictures(a, grey(40, 50)).largest, 100);
}

// A small missing object. It hardly changes the mean, and has less than one pixel in a thousand.
TEST(PictureCheck, FindsTheTileThatDiffersMost) {
  Image8 a = grey(640, 360);
  for (int y = 176; y < 192; ++y)
    for (int x = 320; x < 328; ++x) a.at(x, y)[0] = a.at(x, y)[1] = a.at(x, y)[2] = 160;
  const PictureDifference d = comparePictures(a, grey(640, 360));
  EXPECT_NEAR(d.tile, 30.0, 1e-9);
  EXPECT_LT(d.mean, 0.05);
  EXPECT_EQ(d.largest, 0);
  // The last tile of 40 x 50 pixels is 8 x 2.
  Image8 b = grey(40, 50);
  b.at(39, 49)[1] = 148;
  EXPECT_NEAR(comparePictures(b, grey(40, 50)).tile, 1.0, 1e-9);
}

TEST(PictureCheck, PicturesOfAnotherSizeDiffer) {
  const PictureDifference d = comparePictures(grey(4, 5), grey(5, 4));
  EXPECT_FALSE(d.none());
  EXPECT_FALSE(d.within(255.0, 255.0));
}

}  // namespace
}  // namespace lamplighter
