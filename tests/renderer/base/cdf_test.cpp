// Prefix sums and sampling by cumulative distributions.
#include "renderer/base/cdf.h"

#include <map>

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"

namespace lamplighter {
namespace {

TEST(Scan, GivesTheSumOfTheEntriesBefore) {
  EXPECT_EQ(exclusiveScan(std::span<const uint32_t>()), (std::vector<uint32_t>{0}));
  const std::vector<uint32_t> values{3, 0, 4, 1};
  EXPECT_EQ(exclusiveScan(values), (std::vector<uint32_t>{0, 3, 3, 7, 8}));
  // A float sum would stop growing at 2²⁴.
  std::vector<float> ones(20'000'000, 1.0f);
  EXPECT_EQ(exclusiveScan(ones).back(), 2e7f);
}

TEST(Cdf, SamplesEntriesInProportionToTheirWeight) {
  const std::vector<float> weights{0.0f, 1.0f, 0.0f, 3.0f, 0.0f};
  const Cdf cdf(weights);
  EXPECT_EQ(cdf.total(), 4.0);
  EXPECT_EQ(std::vector<float>(cdf.values().begin(), cdf.values().end()),
            (std::vector<float>{0.0f, 0.0f, 0.25f, 0.25f, 1.0f, 1.0f}));
  std::map<size_t, int> counts;
  for (uint32_t i = 0; i < 4096; ++i) {
    const Cdf::Sample sample = cdf.sample(sobol2(i, 1).x);
    EXPECT_EQ(sample.probability, cdf.probability(sample.index));
    EXPECT_TRUE(sample.within >= 0.0f && sample.within < 1.0f);
    ++counts[sample.index];
  }
  EXPECT_EQ(counts, (std::map<size_t, int>{{1, 1024}, {3, 3072}}));
  EXPECT_FLOAT_EQ(cdf.sample(0.125f).within, 0.5f);
}

TEST(Cdf, OfNothingIsEmpty) {
  EXPECT_TRUE(Cdf().empty());
  EXPECT_TRUE(Cdf(std::span<const float>()).empty());
  EXPECT_TRUE(Cdf(std::vector<float>{0.0f, 0.0f}).empty());
  EXPECT_TRUE(Cdf(std::vector<float>{std::numeric_limits<float>::infinity()}).empty());
}

TEST(Cdf, OneHugeWeightTakesAll) {
  std::vector<float> weights(1000, 1.0f);
  weights[700] = 1e30f;
  const Cdf cdf(weights);
  for (const float u : {1e-6f, 0.5f, 0x1.fffffep-1f}) EXPECT_EQ(cdf.sample(u).index, 700u);
}

TEST(GridCdf, SamplesCellsInProportionToTheirWeight) {
  const GridCdf choice(3, 2, {0, 2, 1, 0, 0, 1});
  EXPECT_FLOAT_EQ(choice.probability(1, 0), 0.5f);
  EXPECT_FLOAT_EQ(choice.probability(2, 1), 0.25f);
  std::map<std::pair<int, int>, int> counts;
  for (uint32_t i = 0; i < 4096; ++i) {
    const GridCdf::Cell cell = choice.sample(sobol2(i, 1));
    EXPECT_GT(cell.probability, 0.0f);
    EXPECT_TRUE(cell.within.x >= 0.0f && cell.within.x < 1.0f);
    ++counts[{cell.x, cell.y}];
  }
  EXPECT_EQ(counts.size(), 3u);
  EXPECT_NEAR(counts.at({1, 0}), 2048, 8);
  EXPECT_TRUE(GridCdf(2, 2, {0, 0, 0, 0}).empty());
  const GridCdf::Cell last =
      choice.sample(vec2(1.0f, 1.0f));  // outside of [0, 1), but must not crash
  EXPECT_GT(last.probability, 0.0f);
}

}  // namespace
}  // namespace lamplighter
