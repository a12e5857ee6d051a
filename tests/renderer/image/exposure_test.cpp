#include "renderer/image/exposure.h"

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

TEST(AutoExposure, MapsAUniformPictureToMiddleGrey) {
  EXPECT_EQ(autoExposureEv(Image(8, 8, vec3(0.18f))), 0.0f);
  EXPECT_EQ(autoExposureEv(Image(8, 8, vec3(0.18f * 4.0f))), -2.0f);
  EXPECT_EQ(autoExposureEv(Image(8, 8, vec3(0.18f / 1024.0f))), 10.0f);
}

TEST(AutoExposure, ALampInViewChangesNothing) {
  Image image(10, 10, vec3(0.18f));
  image.at(3, 3) = vec3(5000.0f);
  EXPECT_EQ(autoExposureEv(image), 0.0f);
}

TEST(AutoExposure, KeepsWhiteObjectsInADarkRoom) {
  Image image(10, 10, vec3(0.002f));
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 10; ++x) image.at(x, y) = vec3(0.5f);
  EXPECT_EQ(autoExposureEv(image), 1.0f);
}

TEST(AutoExposure, IsZeroForABlackPicture) { EXPECT_EQ(autoExposureEv(Image(4, 4)), 0.0f); }

}  // namespace
}  // namespace lamplighter
