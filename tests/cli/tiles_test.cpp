// The command `lamplighter tiles`.
#include <filesystem>

#include <gtest/gtest.h>

#include "renderer/image/image_io.h"
#include "tests/support/folders.h"
#include "tests/support/process.h"

namespace lamplighter::test {
namespace {

namespace fs = std::filesystem;

const std::string kRoom = (sourceFolder() / "assets/scenes/cornell_style.gltf").string();

struct TilesCommand : testing::Test {
  const fs::path file = fs::temp_directory_path() / "lamplighter_tiles_cli.png";
  void TearDown() override { fs::remove(file); }
};

TEST_F(TilesCommand, WritesAPictureOfEachSide) {
  const ProcessResult r = runLamplighter(
      {"tiles", kRoom, "-o", file.string(), "--backend", "cpu", "--size", "60x40", "--columns", "2",
       "--side", "many_lights,antialias=1,indirect=samples", "--side",
       "reference,samples_per_pixel=4", "--side", "reference,samples_per_pixel=4,bounces=0"});
  ASSERT_EQ(r.code, 0) << r.err;
  const Image sheet = readImage(file.string());
  EXPECT_EQ(sheet.width, 3 * 6 + 2 * 60);
  EXPECT_GT(sheet.height, 2 * 40 + 4 * 15);
  // The upper tiles show the same room; the fourth is empty.
  vec3 first(0.0f), second(0.0f);
  for (int y = 6; y < 46; ++y)
    for (int x = 6; x < 66; ++x) {
      first += sheet.at(x, y);
      second += sheet.at(x + 66, y);
    }
  EXPECT_NEAR(luminance(first) / luminance(second), 1.0f, 0.1f);
  EXPECT_EQ(sheet.at(sheet.width - 10, sheet.height - 10), sheet.at(0, 0));
}

TEST_F(TilesCommand, RefusesWhatItCannotDoBeforeTheWork) {
  for (const std::vector<std::string>& wrong : {std::vector<std::string>{"--side", "many_light"},
                                                {"--side", "many_lights,vpl=3"},
                                                {"--side", "live"},
                                                {"--size", "60"},
                                                {"--exposure", "bright"}}) {
    std::vector<std::string> all{"tiles", kRoom, "-o", file.string()};
    all.insert(all.end(), wrong.begin(), wrong.end());
    const ProcessResult r = runLamplighter(all);
    EXPECT_EQ(r.code, 2) << wrong[1];
    EXPECT_EQ(r.err.find("error: "), 0u) << r.err;
    EXPECT_FALSE(fs::exists(file));
  }
}

}  // namespace
}  // namespace lamplighter::test
