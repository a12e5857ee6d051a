#include "renderer/surface_depths/depth_intervals.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "renderer/base/random.h"
#include "renderer/texels/depth_map_layout.h"

namespace lamplighter {
namespace {

std::vector<DepthInterval> randomIntervals(uint32_t seed, size_t count) {
  std::vector<DepthInterval> out(count);
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t a = hash4(i, seed, 0, 1) % 1000, length = hash4(i, seed, 0, 2) % 400;
    out[i] = {static_cast<uint16_t>(a), static_cast<uint16_t>(a + length)};
  }
  return out;
}

// The least number of segments, by dynamic programming.
size_t fewestSegments(const std::vector<DepthInterval>& intervals) {
  std::vector<size_t> fewest(intervals.size() + 1, intervals.size() + 1);
  fewest[0] = 0;
  for (size_t begin = 0; begin < intervals.size(); ++begin) {
    DepthInterval common;
    for (size_t end = begin; end < intervals.size(); ++end) {
      common.least = std::max(common.least, intervals[end].least);
      common.most = std::min(common.most, intervals[end].most);
      if (common.least > common.most) break;
      fewest[end + 1] = std::min(fewest[end + 1], fewest[begin] + 1);
    }
  }
  return fewest.back();
}

TEST(DepthIntervals, ValuesLieInTheirIntervalsAndSegmentsAreFewest) {
  for (uint32_t seed = 0; seed < 20; ++seed) {
    const auto intervals = randomIntervals(seed, 200);
    DepthSegments segments;
    compress(intervals, segments);
    EXPECT_EQ(segments.values.size(), fewestSegments(intervals));
    size_t segment = 0;
    for (size_t t = 0; t < intervals.size(); ++t) {
      if (t > segments.last[segment]) ++segment;
      EXPECT_LE(intervals[t].least, segments.values[segment]);
      EXPECT_GE(intervals[t].most, segments.values[segment]);
    }
    EXPECT_EQ(segments.last.back(), intervals.size() - 1);
  }
}

TEST(DepthIntervals, AWholeRunIsOneSegmentIfItMayBe) {
  DepthSegments segments;
  compress(std::vector<DepthInterval>(kMostInRun, {10, 20}), segments);
  EXPECT_EQ(segments.values, std::vector<uint16_t>{15});
  EXPECT_EQ(segments.last, std::vector<uint8_t>{255});
}

TEST(DepthMapLayout, PixelsAreFoundByTheirDirections) {
  for (const DepthMapKind kind : {DepthMapKind::cube, DepthMapKind::octahedral}) {
    const DepthMapLayout layout{kind, 16};
    double sum = 0.0;
    for (uint32_t q = 0; q < layout.pixels(); ++q) {
      const vec3 d = layout.directionOf(q);
      EXPECT_NEAR(glm::length(d), 1.0f, 1e-5f);
      EXPECT_EQ(layout.pixelOf(3.0f * d), q);
      sum += static_cast<double>(layout.solidAngleOf(q));
    }
    EXPECT_NEAR(sum, 4.0 * kPi, 0.005 * 4.0 * kPi);
  }
}

}  // namespace
}  // namespace lamplighter
