#include "renderer/light_field/field_directions.h"

#include <gtest/gtest.h>

#include "renderer/base/low_discrepancy.h"

namespace lamplighter {
namespace {

vec3 uniformDirection(uint32_t index) {
  const vec2 u = sobol2(index, 77);
  const float z = 1.0f - 2.0f * u.x, side = std::sqrt(std::max(0.0f, 1.0f - z * z));
  return {side * std::cos(2.0f * kPi * u.y), side * std::sin(2.0f * kPi * u.y), z};
}

vec3 endOf(const FieldDirections& directions, const FieldDirections::Triple& triple, size_t k) {
  const vec3& d = directions[triple.directions[k]];
  return triple.areOpposite[k] ? -d : d;
}

TEST(FieldDirections, AreAsManyAsSaidAndDifferent) {
  for (const int f : {1, 2, 4, 16}) {
    const FieldDirections directions(f, 3);
    ASSERT_EQ(directions.size(), static_cast<size_t>(2 * f * f + 1));
    for (size_t a = 0; a < directions.size(); ++a) {
      EXPECT_NEAR(glm::length(directions[a]), 1.0f, 1e-5f);
      for (size_t b = 0; b < a; ++b)
        EXPECT_LT(std::abs(glm::dot(directions[a], directions[b])), 1.0f - 1e-4f);
    }
  }
}

TEST(FieldDirections, WeightsCoverTheSphere) {
  for (const int f : {1, 2, 8, 32}) {
    const FieldDirections directions(f, 5);
    double sum = 0.0;
    for (size_t d = 0; d < directions.size(); ++d)
      sum += static_cast<double>(directions.weightOf(d));
    EXPECT_NEAR(2.0 * sum, 4.0 * static_cast<double>(kPi), 1e-4);
  }
}

// Without normalisation: how exact the sums of even light are.
TEST(FieldDirections, SumsOfCosinesAreNearPi) {
  const auto worst = [](int f) {
    const FieldDirections directions(f, 1);
    double most = 0.0;
    for (uint32_t n = 0; n < 64; ++n) {
      const vec3 normal = uniformDirection(n);
      double sum = 0.0;
      for (size_t d = 0; d < directions.size(); ++d)
        sum +=
            static_cast<double>(directions.weightOf(d) * std::abs(glm::dot(normal, directions[d])));
      most = std::max(most, std::abs(sum / static_cast<double>(kPi) - 1.0));
    }
    ::testing::Test::RecordProperty("error" + std::to_string(directions.size()),
                                    std::to_string(most));
    return most;
  };
  EXPECT_LT(worst(8), 0.006);    // 129 directions
  EXPECT_LT(worst(16), 0.0015);  // 513
}

TEST(FieldDirections, TriplesAreAroundTheDirection) {
  const FieldDirections directions(16, 2);
  for (uint32_t i = 0; i < 2000; ++i) {
    const vec3 d = uniformDirection(i);
    const FieldDirections::Triple triple = directions.tripleOf(d);
    vec3 mean(0.0f);
    float sum = 0.0f, longest = 0.0f;
    for (size_t k = 0; k < 3; ++k) {
      EXPECT_GE(triple.weights[k], 0.0f);
      sum += triple.weights[k];
      mean += triple.weights[k] * endOf(directions, triple, k);
      if (triple.weights[k] > 0.0f) {
        EXPECT_GT(glm::dot(endOf(directions, triple, k), d), std::cos(0.16f));
      }
    }
    EXPECT_NEAR(sum, 1.0f, 1e-5f);
    // The map is curved: the weights are not those of the flat triangle, but near them.
    for (size_t k = 0; k < 3; ++k)
      longest = std::max(longest, glm::distance(endOf(directions, triple, k),
                                                endOf(directions, triple, (k + 1) % 3)));
    EXPECT_LT(glm::distance(glm::normalize(mean), d), 0.25f * longest);
  }
}

TEST(FieldDirections, TheTripleOfADirectionIsItself) {
  const FieldDirections directions(8, 9);
  for (size_t d = 0; d < directions.size(); ++d) {
    for (const float sign : {1.0f, -1.0f}) {
      const FieldDirections::Triple triple = directions.tripleOf(sign * directions[d]);
      float own = 0.0f;
      for (size_t k = 0; k < 3; ++k)
        if (glm::dot(endOf(directions, triple, k), sign * directions[d]) > 1.0f - 1e-5f)
          own += triple.weights[k];
      EXPECT_NEAR(own, 1.0f, 2e-3f) << d;
    }
  }
}

// The integral of the weights of an end is its weight.
TEST(FieldDirections, WeightsAreIntegralsOfTheHats) {
  const FieldDirections directions(3, 4);
  constexpr uint32_t kCount = 1 << 17;
  std::vector<double> sums(directions.size(), 0.0);
  for (uint32_t i = 0; i < kCount; ++i) {
    const FieldDirections::Triple triple = directions.tripleOf(uniformDirection(i));
    for (size_t k = 0; k < 3; ++k)
      sums[triple.directions[k]] += static_cast<double>(triple.weights[k]);
  }
  for (size_t d = 0; d < directions.size(); ++d) {
    // Of both ends.
    const double expected = static_cast<double>(2.0f * directions.weightOf(d));
    EXPECT_NEAR(4.0 * static_cast<double>(kPi) * sums[d] / kCount, expected, 0.01 * expected);
  }
}

}  // namespace
}  // namespace lamplighter
