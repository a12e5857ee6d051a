#include "renderer/image/image_io.h"

#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"
#include "tests/support/folders.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

fs::path temporary(const std::string& name) {
  return fs::path(testing::TempDir()) / ("lamplighter_" + name);
}

TEST(ImageIo, ExrKeepsEveryBit) {
  Image image(7, 5);
  for (size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = vec3(static_cast<float>(i) / 3.0f, 1e-6f, 12345.678f);
  const fs::path path = temporary("bits.exr");
  writeExr(image, path);
  const Image back = readImage(path);
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.pixels, image.pixels);
  fs::remove(path);
}

TEST(ImageIo, PngIsReadAsLinearValues) {
  Image8 image(2, 1);
  for (int c = 0; c < 3; ++c) image.at(0, 0)[c] = 188;  // about 0.5 in linear values
  const fs::path path = temporary("linear.png");
  writePng(image, path);
  const Image back = readImage(path);
  EXPECT_NEAR(back.at(0, 0).r, 0.5029f, 1e-3f);
  EXPECT_EQ(back.at(1, 0), vec3(1.0f));
  fs::remove(path);
}

TEST(ImageIo, AMissingFolderGivesOneLine) {
  try {
    writeExr(Image(2, 2), temporary("none") / "a.exr");
    FAIL() << "no exception";
  } catch (const InputError& e) {
    EXPECT_NE(std::string(e.what()).find("a.exr: cannot be written"), std::string::npos)
        << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(ImageIo, AFileThatIsNotAnImageIsRejected) {
  EXPECT_THROW(readImage(temporary("absent.exr")), InputError);
  EXPECT_THROW(readImage(test::sourceFolder() / "README.md"), InputError);
}

TEST(ImageIo, AFailedWriteLeavesTheOldFile) {
  const fs::path folder = temporary("folder");
  fs::create_directories(folder / "taken.exr");  // a folder where the file should go
  EXPECT_THROW(writeExr(Image(2, 2), folder / "taken.exr"), InputError);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder), fs::directory_iterator()), 1);
  fs::remove_all(folder);
}

// The curve and the sRGB encoding, computed by hand: 1 → 2.54 / 3.16 = 0.80380 → 0.90823, 0.18 →
// 0.086724 / 0.324932 = 0.26690 → 0.55346.
TEST(ToneMap, IsTheCurveThenTheEncoding) {
  EXPECT_NEAR(toneMapPixel(vec3(1.0f), 0.0f).r, 0.90823f, 1e-5f);
  EXPECT_NEAR(toneMapPixel(vec3(0.18f), 0.0f).g, 0.55346f, 1e-5f);
  Image image(2, 1);
  image.at(0, 0) = vec3(1.0f, 0.18f, 0.0f);
  image.at(1, 0) =
      vec3(std::numeric_limits<float>::quiet_NaN(), -1.0f, std::numeric_limits<float>::infinity());
  const Image8 out = toneMap(image, 0.0f);
  EXPECT_EQ(std::vector<int>(out.at(0, 0), out.at(0, 0) + 4), (std::vector<int>{232, 141, 0, 255}));
  EXPECT_EQ(std::vector<int>(out.at(1, 0), out.at(1, 0) + 4), (std::vector<int>{0, 0, 255, 255}));
}

TEST(ToneMap, GrowsWithRadianceAndExposureAndEndsInWhite) {
  float last = -1.0f;
  for (float r = 0.0f; r < 20.0f; r += 0.05f) {
    const float now = toneMapPixel(vec3(r), 0.0f).r;
    EXPECT_GE(now, last);
    last = now;
  }
  EXPECT_EQ(toneMapPixel(vec3(0.25f), 2.0f), toneMapPixel(vec3(1.0f), 0.0f));
  EXPECT_EQ(toneMapPixel(vec3(1e30f), 10.0f), vec3(1.0f));
  EXPECT_EQ(toneMapPixel(vec3(0.0f), 0.0f), vec3(0.0f));
}

}  // namespace
}  // namespace lamplighter
