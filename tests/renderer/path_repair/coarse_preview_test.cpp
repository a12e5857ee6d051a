// A first repair by paths of blocks of pixels.
#include "renderer/path_repair/coarse_preview.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/renderer/path_repair/wall_and_floor.h"

namespace lamplighter {
namespace {

// Not multiples of the side of a block.
constexpr int kWidth = 130, kHeight = 95, kSide = 3;

// In the first columns the sky.
RepairGuides wallAndFloorAtTheSky() {
  RepairGuides guides = test::wallAndFloor(kWidth, kHeight, 9);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 4; ++x) guides.normal[static_cast<size_t>(y * kWidth + x)] = vec3(0.0f);
  return guides;
}

struct Coarse : testing::Test {
  const RepairGuides guides = wallAndFloorAtTheSky();
  Image truth{kWidth, kHeight}, live{kWidth, kHeight};
  CoarsePreview preview{guides, kSide};

  Coarse() {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        const vec3& albedo = guides.albedo[static_cast<size_t>(y * kWidth + x)];
        truth.at(x, y) = albedo * (y > kHeight / 2 ? 2.0f : 1.0f);
        live.at(x, y) = 0.5f * truth.at(x, y);
      }
  }
  // Paths of each block, through its pixels in turn: one in `rare` finds light.
  const Image& repaired(int paths, uint32_t rare) {
    const RepairGuides& blocks = preview.blocks();
    for (int path = 0; path < paths; ++path) {
      for (int y = 0; y < blocks.height; ++y)
        for (int x = 0; x < blocks.width; ++x) {
          if (blocks.isAtLight(x, y)) continue;
          const auto block = static_cast<size_t>(y * blocks.width + x);
          const glm::ivec2 pixel = preview.nextPixel();
          const int u = std::min(kSide * x + pixel.x, kWidth - 1),
                    v = std::min(kSide * y + pixel.y, kHeight - 1);
          for (const bool isFirst : {true, false}) {
            const uint32_t bits = hash4(static_cast<uint32_t>(block), static_cast<uint32_t>(path),
                                        isFirst ? 1 : 2, 3);
            const float factor = bits % rare == 0 ? static_cast<float>(rare) : 0.0f;
            preview.add(isFirst, block, factor * truth.at(u, v));
          }
        }
      preview.endPaths();
    }
    preview.beginFilter(std::make_shared<HostImage>(live));
    while (preview.isFiltering()) preview.filter(7);
    return preview.image()->pixels();
  }
  // Root of the mean squared error of surfaces, of their mean.
  double errorOf(const Image& picture) const {
    double error = 0.0, light = 0.0, pixels = 0.0;
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x) {
        if (guides.isAtLight(x, y)) continue;
        const auto d = static_cast<double>(picture.at(x, y).x - truth.at(x, y).x);
        error += d * d;
        light += static_cast<double>(truth.at(x, y).x);
        pixels += 1.0;
      }
    return std::sqrt(error / pixels) / (light / pixels);
  }
};

TEST_F(Coarse, ShowsWhatIsMissingWithTheDetailOfThePicture) {
  EXPECT_LT(errorOf(repaired(kSide * kSide, 1)), 0.15 * errorOf(live));
}

TEST_F(Coarse, FewNoisyPathsAreEnough) {
  const double error = errorOf(repaired(1, 8));
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, 0.7 * errorOf(live));
}

TEST_F(Coarse, TheSkyStaysAsItIs) {
  const Image& picture = repaired(1, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < 4; ++x) EXPECT_EQ(picture.at(x, y), live.at(x, y));
}

// No texture counts as an error of the picture.
TEST_F(Coarse, ARightPictureStaysAsItIs) {
  for (uint32_t i = 0; i < truth.pixels.size(); ++i)
    truth.pixels[i] *= 0.5f + toUnitFloat(hash4(i, 5, 6, 7));
  live = truth;
  EXPECT_LT(errorOf(repaired(1, 1)), 0.001);
}

// The block of the first column beside the sky shows nothing, but others around it do.
TEST_F(Coarse, PixelsBesideBlocksWithoutASurfaceAreRepaired) {
  const Image& picture = repaired(1, 1);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 4; x < 8; ++x) EXPECT_GT(picture.at(x, y).x, 1.5f * live.at(x, y).x);
}

// A rail that no block shows is scaled as what is around it.
TEST(CoarsePreviewTest, PixelsThatNoBlockShowsAreScaled) {
  RepairGuides guides = wallAndFloorAtTheSky();
  constexpr int kRow = 18;  // not in the middle of a block
  for (int x = 4; x < kWidth; ++x) {
    guides.normal[kRow * kWidth + x] = vec3(0, 0, -1);
    guides.albedo[kRow * kWidth + x] = vec3(0.5f);
  }
  CoarsePreview preview(guides, kSide);
  const RepairGuides& blocks = preview.blocks();
  for (size_t i = 0; i < blocks.albedo.size(); ++i)
    if (blocks.normal[i] != vec3(0.0f))
      for (const bool isFirst : {true, false}) preview.add(isFirst, i, vec3(1.5f));
  preview.endPaths();
  Image live(kWidth, kHeight);
  for (vec3& p : live.pixels) p = vec3(1.0f);
  preview.beginFilter(std::make_shared<HostImage>(live));
  while (preview.isFiltering()) preview.filter(100);
  EXPECT_NEAR(preview.image()->pixels().at(60, kRow).x, 1.5f, 0.1f);
}

TEST(CoarsePreviewTest, LargePicturesHaveLargerBlocks) {
  EXPECT_EQ(CoarsePreview::sideOf(320, 240), 1);
  EXPECT_EQ(CoarsePreview::sideOf(512, 384), 2);
  EXPECT_EQ(CoarsePreview::sideOf(1280, 720), 4);
  EXPECT_EQ(CoarsePreview::sideOf(3840, 2160), 4);
}

}  // namespace
}  // namespace lamplighter
