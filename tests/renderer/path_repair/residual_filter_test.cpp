// The filter of residuals against pictures whose truth and noise are known.
#include "renderer/path_repair/residual_filter.h"

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "tests/renderer/path_repair/wall_and_floor.h"
#include "tests/support/scenes/lit_scene.h"

namespace lamplighter {
namespace {

constexpr int kWidth = 128, kHeight = 96;

// Each pixel shows another surface than its neighbours.
RepairGuides leavesLike(const RepairGuides& guides) {
  RepairGuides leaves = guides;
  for (size_t i = 0; i < leaves.normal.size(); ++i) {
    const float turn = 2.4f * static_cast<float>(i % 251);
    leaves.normal[i] = glm::normalize(vec3(std::cos(turn), std::sin(turn), 0.5f));
    leaves.position[i].z = static_cast<float>(i % 17);
  }
  return leaves;
}

// The light of the truth: 2 on the floor, and on the wall 1 with a bright disc.
float lightAt(int x, int y) {
  if (y >= kHeight / 2) return 2.0f;
  const float dx = static_cast<float>(x - 64), dy = static_cast<float>(y - 24);
  return dx * dx + dy * dy < 100.0f ? 3.0f : 1.0f;
}

struct Residuals : testing::Test {
  const RepairGuides guides = test::wallAndFloor(kWidth, kHeight, 8);
  Image truth{kWidth, kHeight}, live{kWidth, kHeight};
  PathSums sums;
  int rows = kHeight;  // of the filter in each call

  Residuals() {
    for (int y = 0; y < kHeight; ++y)
      for (int x = 0; x < kWidth; ++x)
        truth.at(x, y) = guides.albedo[static_cast<size_t>(y * kWidth + x)] * lightAt(x, y);
    live = truth;
  }
  // Sums of paths: each finds nothing, or, one in `rare`, the truth times that.
  void trace(int paths, uint32_t rare) {
    sums = PathSums(kWidth, kHeight);
    for (int path = 0; path < paths; ++path) {
      const bool isFirst = path % 2 == 0;
      for (size_t i = 0; i < truth.pixels.size(); ++i) {
        const uint32_t bits =
            hash4(static_cast<uint32_t>(i), static_cast<uint32_t>(path / 2), isFirst ? 1 : 2, 7);
        if (bits % rare == 0)
          sums.add(isFirst, i, static_cast<float>(rare) * truth.pixels[i]);
        else
          sums.add(isFirst, i, vec3(0.0f));
      }
      sums.endPath();
    }
  }
  Image repaired() const {
    Image out = residualOf(guides);
    for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += live.pixels[i];
    return out;
  }
  Image residualOf(const RepairGuides& shown) const {
    ResidualFilter filter(shown, live, sums);
    while (!filter.isDone()) filter.step(rows);
    return filter.takeResidual();
  }
  // Root of the mean squared error, of the mean of the truth.
  double errorOf(const Image& picture) const {
    double error = 0.0, mean = 0.0;
    for (size_t i = 0; i < picture.pixels.size(); ++i) {
      const double d = static_cast<double>(picture.pixels[i].x - truth.pixels[i].x);
      error += d * d;
      mean += static_cast<double>(truth.pixels[i].x);
    }
    const auto pixels = static_cast<double>(picture.pixels.size());
    return std::sqrt(error / pixels) / (mean / pixels);
  }
  Image meanOfPaths() const {
    Image out(kWidth, kHeight);
    for (size_t i = 0; i < out.pixels.size(); ++i)
      out.pixels[i] =
          (sums.first.pixels[i] + sums.second.pixels[i]) / static_cast<float>(sums.paths);
    return out;
  }
};

TEST_F(Residuals, WithoutNoiseTheTruthIsShown) {
  for (vec3& p : live.pixels) p *= 0.5f;
  trace(4096, 1);
  EXPECT_LT(errorOf(repaired()), 0.001);
}

TEST_F(Residuals, NoiseDoesNotShowInAPictureThatIsRight) {
  for (const int paths : {2, 8, 32, 128}) {
    trace(paths, 8);
    const double noise = errorOf(meanOfPaths()), shown = errorOf(repaired());
    RecordProperty("noise" + std::to_string(paths), std::to_string(noise));
    RecordProperty("shown" + std::to_string(paths), std::to_string(shown));
    EXPECT_LT(shown, 0.05 * noise) << paths;
  }
}

// A picture that is a third too dark, and even darker in a corner.
TEST_F(Residuals, ASmoothErrorIsRepairedLongBeforeTheNoiseIsGone) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      live.at(x, y) *= 0.67f - 0.3f * std::exp(-0.001f * static_cast<float>(x * x));
  double last = errorOf(live);
  const double before = last;
  for (const int paths : {8, 32, 128}) {
    trace(paths, 8);
    const double noise = errorOf(meanOfPaths()), error = errorOf(repaired());
    RecordProperty("error" + std::to_string(paths), std::to_string(error));
    EXPECT_LT(error, last) << paths;
    EXPECT_LT(error, 0.25 * noise) << paths;
    last = error;
  }
  EXPECT_LT(last, 0.15 * before);
}

// Noise of far more than the error does not hide how large it is.
TEST_F(Residuals, TheErrorOfThePictureIsFound) {
  const auto errorFound = [&] {
    ResidualFilter filter(guides, live, sums);
    while (!filter.isDone()) filter.step(rows);
    return filter.error();
  };
  trace(8, 8);
  EXPECT_LT(errorFound(), 0.05f);
  for (vec3& p : live.pixels) p *= 0.8f;
  EXPECT_NEAR(errorFound(), 0.25f, 0.05f);
}

TEST_F(Residuals, AMissingDetailComesWithThePaths) {
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x)
      live.at(x, y) = guides.albedo[static_cast<size_t>(y * kWidth + x)];  // without the disc
  const double before = errorOf(live);
  trace(128, 8);
  EXPECT_LT(errorOf(repaired()), 0.6 * before);
  trace(2048, 8);
  EXPECT_LT(errorOf(repaired()), 0.15 * before);
}

TEST_F(Residuals, DoNotDependOnTheRowsOfACall) {
  for (vec3& p : live.pixels) p *= 0.5f;
  trace(32, 2);
  const Image whole = residualOf(guides);
  rows = 7;
  EXPECT_TRUE(test::sameBits(whole, residualOf(guides)));
}

// A line one pixel wide, such as the edge of a shadow at the wrong place: no band shows it.
TEST_F(Residuals, ASingleLineIsShownOnceItExceedsTheNoise) {
  for (int y = 4; y < kHeight / 2; ++y) live.at(20, y) *= 0.4f;
  const double before = errorOf(live);
  for (const int paths : {64, 1024}) {
    trace(paths, 2);
    const double error = errorOf(repaired());
    RecordProperty("error" + std::to_string(paths), std::to_string(error));
    EXPECT_LT(error, (paths == 64 ? 0.6 : 0.15) * before) << paths;
  }
}

// Leaves, legs of chairs: pixels whose neighbours show other surfaces have nothing to share.
TEST_F(Residuals, PixelsWithoutNeighboursTakeTheirOwnPaths) {
  const RepairGuides leaves = leavesLike(guides);
  for (vec3& p : live.pixels) p *= 0.5f;
  trace(64, 1);
  const Image residual = residualOf(leaves);
  for (size_t i = 0; i < residual.pixels.size(); ++i)
    EXPECT_GE(residual.pixels[i].x, 0.79f * live.pixels[i].x);
}

TEST_F(Residuals, PixelsWithoutNeighboursShowLittleNoiseOfRightPictures) {
  trace(32, 4);
  Image out = residualOf(leavesLike(guides));
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += live.pixels[i];
  EXPECT_LT(errorOf(out), 0.4 * errorOf(meanOfPaths()));
}

// Thin and bright bars off a dark wall, whose noise few pixels share.
TEST_F(Residuals, BarsLeaveNoCopiesOfTheirNoiseOnAWall) {
  RepairGuides bars = guides;
  const auto isBar = [](size_t i) { return i / kWidth % 12 == 6; };
  for (size_t i = 0; i < bars.albedo.size(); ++i) {
    bars.albedo[i] = vec3(isBar(i) ? 0.9f : 0.05f);
    bars.normal[i] = vec3(0, 0, 1);
    bars.position[i].z = isBar(i) ? 0.025f : 0.0f;
    bars.position[i].y = -0.01f * static_cast<float>(i / kWidth);
    truth.pixels[i] = bars.albedo[i];
  }
  live = truth;
  for (vec3& p : live.pixels) p *= 0.5f;
  trace(24, 12);
  const Image residual = residualOf(bars);
  double error = 0.0, walls = 0.0;
  for (size_t i = 0; i < residual.pixels.size(); ++i) {
    if (isBar(i)) continue;
    const float above =
        i < kWidth || isBar(i - kWidth) ? residual.pixels[i].x : residual.pixels[i - kWidth].x;
    error += glm::pow(static_cast<double>((residual.pixels[i].x - above) / 0.025f), 2.0);
    walls += 1.0;
  }
  EXPECT_LT(std::sqrt(error / walls), 0.04);
}

// Of two halves, whose groups of four are independent: a variance of groups is that of paths over
// four.
TEST(PathSumsTest, TheVarianceIsThatOfTheMean) {
  constexpr int kPixels = 2000, kPaths = 62;  // the last groups are not complete
  PathSums sums(kPixels, 1);
  for (int path = 0; path < kPaths; ++path) {
    if (path % 2 == 0) {
      EXPECT_EQ(sums.knowsVariance(), path >= 16);
    }
    for (uint32_t i = 0; i < kPixels; ++i) {
      const float u = toUnitFloat(hash4(i, static_cast<uint32_t>(path), 1, 2));
      sums.add(path % 2 == 0, i, vec3(u, 0.0f, 2.0f * u));
    }
    sums.endPath();
  }
  double variance = 0.0;
  for (size_t i = 0; i < kPixels; ++i) variance += static_cast<double>(sums.variance(i)) / kPixels;
  EXPECT_NEAR(variance, 5.0 / 12.0 / kPaths, 0.0003);
}

// As if each path had been added minus something.
TEST(PathSumsTest, SumsCanBeJoined) {
  constexpr int kPixels = 100;
  const auto pathOf = [](uint32_t pixel, int path) {
    return vec3(toUnitFloat(hash4(pixel, static_cast<uint32_t>(path), 3, 4)), 0.5f, 1.0f);
  };
  Image taken(kPixels, 1);
  for (uint32_t i = 0; i < kPixels; ++i) taken.pixels[i] = vec3(0.01f * static_cast<float>(i));
  PathSums all(kPixels, 1), first(kPixels, 1), second(kPixels, 1);
  for (int path = 0; path < 36; ++path) {
    PathSums& part = path < 24 ? first : second;
    for (uint32_t i = 0; i < kPixels; ++i) {
      const vec3 radiance = pathOf(i, path);
      all.add(path % 2 == 0, i, path < 24 ? radiance - taken.pixels[i] : radiance);
      part.add(path % 2 == 0, i, radiance);
    }
    all.endPath();
    part.endPath();
  }
  const PathSums whole = first;
  first.subtract(taken);
  first.scale(0.5f);
  first.scale(2.0f);
  first.add(second);
  EXPECT_EQ(first.paths, all.paths);
  EXPECT_EQ(first.weight, 36.0f);
  EXPECT_NEAR(whole.noise(), 100.0 / 12.0, 3.0);  // a hundred pixels, evenly from 0 to 1
  for (uint32_t i = 0; i < kPixels; ++i) {
    EXPECT_NEAR(first.variance(i), all.variance(i), 1e-5f);
    EXPECT_NEAR(first.first.pixels[i].x, all.first.pixels[i].x, 1e-4f);
    EXPECT_NEAR(first.second.pixels[i].y, all.second.pixels[i].y, 1e-4f);
  }
}

TEST_F(Residuals, NothingIsSharedAcrossAnEdge) {
  for (int y = 0; y < kHeight / 2; ++y)
    for (int x = 0; x < kWidth; ++x) live.at(x, y) = vec3(0.0f);  // the wall is black
  trace(2, 1);
  const Image out = repaired();
  // But for the corners of the floor, whose pixels have few neighbours.
  for (int y = kHeight / 2; y < kHeight; ++y)
    for (int x = 1; x < kWidth - 1; ++x) EXPECT_EQ(out.at(x, y), truth.at(x, y));
}

// The sky, lamps and their borders: nearer to the truth than the picture and the mean of paths.
TEST_F(Residuals, WhatShowsNoSurfaceTakesItsOwnPaths) {
  RepairGuides sky = guides;
  sky.normal.assign(sky.normal.size(), vec3(0.0f));
  const auto errorRepaired = [&] {
    Image out = residualOf(sky);
    for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += live.pixels[i];
    return errorOf(out);
  };
  trace(16, 4);
  EXPECT_LT(errorRepaired(), 0.05 * errorOf(meanOfPaths()));
  for (vec3& p : live.pixels) p *= 0.5f;
  for (const int paths : {4, 16, 64}) {
    trace(paths, 4);
    EXPECT_LT(errorRepaired(), 0.97 * std::min(errorOf(live), errorOf(meanOfPaths()))) << paths;
  }
  trace(64, 1);
  EXPECT_LT(errorRepaired(), 1e-4);
}

// Bars of a window that the picture does not have: few of all pixels that show no surface.
TEST_F(Residuals, ThinBarsAreShownThoughOtherBordersAreNoise) {
  RepairGuides sky = guides;
  sky.normal.assign(sky.normal.size(), vec3(0.0f));
  trace(16, 4);
  constexpr int kWindow = 32, kBar = 16;  // left of it the paths show a window without noise
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWindow; ++x) {
      const auto i = static_cast<size_t>(y * kWidth + x);
      sums.first.pixels[i] = sums.second.pixels[i] = 8.0f * truth.pixels[i];
      if (x == kBar) live.pixels[i] = 1.5f * truth.pixels[i];
    }
  const Image residual = residualOf(sky);
  for (int y = 0; y < kHeight; ++y)
    EXPECT_NEAR(residual.at(kBar, y).x, -0.5f * truth.at(kBar, y).x, 1e-3f);
  double noise = 0.0;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 2 * kWindow; x < kWidth; ++x)
      noise += static_cast<double>(std::abs(residual.at(x, y).x) / truth.at(x, y).x);
  EXPECT_LT(noise / (kHeight * (kWidth - 2 * kWindow)), 0.05);
}

// Few paths, whose noise is larger than a pattern of the picture, tell that the pattern is wrong.
TEST_F(Residuals, APatternOfThePictureThatPathsDoNotHaveVanishes) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) live.at(x, y) *= (x / 2 + y / 2) % 2 == 0 ? 1.4f : 0.6f;
  const double before = errorOf(live);
  trace(8, 2);
  const double after = errorOf(repaired());
  RecordProperty("share", std::to_string(after / before));
  EXPECT_LT(after, 0.5 * before);
  EXPECT_LT(after, 0.75 * errorOf(meanOfPaths()));
}

// Where the pixels around agree, detail is shown with fewer paths than elsewhere: a mirror image.
TEST_F(Residuals, DetailInWhichPixelsAgreeIsShownWithFewPaths) {
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      live.at(x, y) = vec3(0.5f) * guides.albedo[static_cast<size_t>(y * kWidth + x)];
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      truth.at(x, y) =
          guides.albedo[static_cast<size_t>(y * kWidth + x)] * (x / 6 % 2 == 0 ? 4.0f : 0.5f);
  trace(4, 1);
  const double error = errorOf(repaired());
  RecordProperty("error", std::to_string(error));
  EXPECT_LT(error, 0.25 * errorOf(live));
}

// With few paths, pixels without neighbours are scaled as those around them.
TEST_F(Residuals, PixelsWithoutNeighboursFollowTheirSurroundings) {
  const RepairGuides leaves = leavesLike(guides);
  for (vec3& p : live.pixels) p *= 0.5f;
  trace(8, 2);
  Image out = residualOf(leaves);
  for (size_t i = 0; i < out.pixels.size(); ++i) out.pixels[i] += live.pixels[i];
  EXPECT_LT(errorOf(out), 0.7 * errorOf(live));
  EXPECT_LT(errorOf(out), 0.9 * errorOf(meanOfPaths()));
}

TEST(WindowResidual, ScalesThePictureAsInItsWindow) {
  RepairGuides guides;
  guides.width = guides.height = 5;
  guides.normal.assign(25, vec3(0, 0, 1));
  guides.normal[3] = vec3(0.0f);  // the sky counts for nothing
  guides.position.assign(25, vec3(0.0f));
  guides.footprint.assign(25, 0.01f);
  Image picture(5, 5);
  std::vector<Halves> residuals(25);
  for (size_t i = 0; i < 25; ++i) {
    picture.pixels[i] = vec3(1.0f + static_cast<float>(i));
    residuals[i] = {0.5f * picture.pixels[i], -0.25f * picture.pixels[i]};
  }
  residuals[3].first = vec3(1000.0f);
  const Halves at = windowResidual(guides, picture, residuals, 2, 2, 2);
  EXPECT_NEAR(at.first.x, 0.5f * 13.0f, 1e-4f);
  EXPECT_NEAR(at.second.x, -0.25f * 13.0f, 1e-4f);
}

// A moulding, one pixel wide, in a wall whose residual is another.
TEST(WindowResidual, PixelsOfTheSameSurfaceCountMost) {
  constexpr int kSize = 9, kRow = 4;
  RepairGuides guides;
  guides.width = guides.height = kSize;
  Image picture(kSize, kSize);
  std::vector<Halves> residuals;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      guides.normal.push_back(y == kRow ? vec3(0, 1, 0) : vec3(0, 0, 1));
      guides.position.emplace_back(0.01f * static_cast<float>(x), y == kRow ? 0.05f : 0.0f, 0.0f);
      guides.footprint.push_back(0.01f);
      picture.at(x, y) = vec3(1.0f);
      residuals.push_back(y == kRow ? Halves{vec3(1.0f), vec3(1.0f)} : Halves());
    }
  EXPECT_GT(windowResidual(guides, picture, residuals, 4, kRow, 4).mean().x, 0.6f);
  EXPECT_LT(windowResidual(guides, picture, residuals, 4, kRow + 1, 4).mean().x, 0.05f);
}

}  // namespace
}  // namespace lamplighter
