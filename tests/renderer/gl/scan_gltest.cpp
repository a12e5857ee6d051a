// Prefix sums and cumulative distributions by compute shaders equal those of the CPU.
#include <cmath>

#include "renderer/base/cdf.h"
#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/gl/scan.h"
#include "renderer/gl/shader_source.h"
#include "tests/renderer/gl/gl_test.h"

namespace lamplighter {
namespace {

using GlScan = test::GlTest;

constexpr size_t kLengths[] = {0, 1, 255, 256, 257, 65'536, 100'000};

std::vector<float> randomWeights(size_t count, uint32_t seed) {
  std::vector<float> weights(count);
  // A third of the weights is zero.
  for (uint32_t i = 0; i < count; ++i)
    weights[i] =
        std::max(0.0f, 1.5f * (static_cast<float>(hash4(i, seed, 0, 0) >> 8) * 0x1p-24f) - 0.5f);
  return weights;
}

void expectNear(const std::vector<float>& actual, std::span<const float> expected,
                float tolerance) {
  ASSERT_EQ(actual.size(), expected.size());
  for (size_t i = 0; i < actual.size(); ++i) ASSERT_NEAR(actual[i], expected[i], tolerance) << i;
}

TEST_F(GlScan, SumsIntegersExactly) {
  gl::Scan<uint32_t> scan(gl::defaultShaderFolder());
  for (const size_t length : kLengths) {
    std::vector<uint32_t> values(length);
    for (uint32_t i = 0; i < length; ++i) values[i] = hash4(i, 1, 0, 0) % 1000;
    gl::StorageBuffer<uint32_t> in, out;
    in.set(values);
    scan.run(in, length, 1, out);
    EXPECT_EQ(test::read(out), exclusiveScan(values)) << length;
  }
}

TEST_F(GlScan, SumsFloatsRowByRow) {
  gl::Scan<float> scan(gl::defaultShaderFolder());
  for (const size_t columns : {1u, 300u, 1000u}) {
    constexpr size_t kRows = 7;
    const std::vector<float> values = randomWeights(columns * kRows, 3);
    gl::StorageBuffer<float> in, out;
    in.set(values);
    scan.run(in, columns, kRows, out);
    std::vector<float> expected;
    for (size_t row = 0; row < kRows; ++row) {
      const auto sums = exclusiveScan(std::span(values).subspan(row * columns, columns));
      expected.insert(expected.end(), sums.begin(), sums.end());
    }
    expectNear(test::read(out), expected, 1e-6f * static_cast<float>(columns));
    const std::vector<float> first = test::read(out);
    scan.run(in, columns, kRows, out);
    EXPECT_EQ(first, test::read(out));  // bit for bit
  }
}

TEST_F(GlScan, GivesTheDistributionOfTheCpu) {
  gl::CdfPass pass(gl::defaultShaderFolder());
  for (const size_t length : kLengths) {
    if (length == 0) continue;
    std::vector<float> weights = randomWeights(length, 5);
    weights.back() = 0.5f;
    gl::StorageBuffer<float> in, cdf, totals;
    in.set(weights);
    pass.run(in, length, 1, cdf, totals);
    const Cdf expected(weights);
    expectNear(test::read(cdf), expected.values(), 1e-6f);
    EXPECT_NEAR(test::read(totals)[0] / expected.total(), 1.0, 1e-6) << length;
  }
}

TEST_F(GlScan, IsUniformForZerosAndHandlesOneHugeWeight) {
  gl::CdfPass pass(gl::defaultShaderFolder());
  std::vector<float> weights(3000, 0.0f);
  std::fill(weights.begin() + 1000, weights.begin() + 2000, 1.0f);
  weights[1700] = 1e30f;
  gl::StorageBuffer<float> in, cdf, totals;
  in.set(weights);
  pass.run(in, 1000, 3, cdf, totals);
  const std::vector<float> shares = test::read(cdf);
  for (size_t i = 0; i <= 1000; ++i) {
    // GLSL divides with an error of 2.5 ULP.
    EXPECT_NEAR(shares[i], static_cast<float>(i) / 1000.0f, 5e-7f);
    if (i > 700) {
      EXPECT_EQ(shares[1001 + i], 1.0f);
    } else {
      EXPECT_LT(shares[1001 + i], 1e-20f);
    }
  }
  EXPECT_EQ(test::read(totals), (std::vector<float>{0.0f, 1e30f, 0.0f}));
}

TEST_F(GlScan, ShadersSampleTheDistribution) {
  constexpr size_t kCount = 1000;
  const std::vector<float> weights = randomWeights(kCount, 9);
  gl::CdfPass pass(gl::defaultShaderFolder());
  gl::StorageBuffer<float> in, cdf, totals, numbers, within;
  in.set(weights);
  pass.run(in, kCount, 1, cdf, totals);
  std::vector<float> u;
  for (uint32_t i = 0; i < 4096; ++i) u.push_back(sobol2(i, 1).x);
  numbers.set(u);
  gl::StorageBuffer<uint32_t> found;
  found.resize(u.size());
  within.resize(u.size());
  const gl::ComputeProgram sample(gl::defaultShaderFolder(),
                                  "../tests/renderer/gl/sample_cdf.comp.glsl");
  cdf.bind(0);
  numbers.bind(1);
  found.bind(2);
  within.bind(3);
  sample.set(0, static_cast<int>(kCount));
  sample.dispatch(static_cast<uint32_t>(u.size()), GL_SHADER_STORAGE_BARRIER_BIT);
  const std::vector<uint32_t> indices = test::read(found);
  const std::vector<float> rests = test::read(within);
  const Cdf expected(weights);
  for (size_t i = 0; i < u.size(); ++i) {
    ASSERT_LT(indices[i], kCount);
    EXPECT_TRUE(rests[i] >= 0.0f && rests[i] < 1.0f);
    // The position of the sample in the CPU's distribution.
    EXPECT_NEAR(expected.values()[indices[i]] + rests[i] * expected.probability(indices[i]), u[i],
                1e-6f);
    EXPECT_TRUE(weights[indices[i]] > 0.0f);
  }
}

}  // namespace
}  // namespace lamplighter
