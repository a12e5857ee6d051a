// Spherical harmonics against closed forms.
#include "renderer/prt/spherical_harmonics.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

namespace lamplighter {
namespace {

constexpr double kPiD = 3.14159265358979323846;

// ∫ f over the sphere by the midpoint rule in z and φ. In φ it is exact for frequencies below
// `around`; in z the error is proportional to 1/n².
double integrate(const std::function<double(const vec3&)>& f, int up = 800, int around = 24) {
  double sum = 0.0;
  for (int i = 0; i < up; ++i) {
    const double z = 2.0 * (i + 0.5) / up - 1.0, s = std::sqrt(1.0 - z * z);
    for (int j = 0; j < around; ++j) {
      const double phi = 2.0 * kPiD * (j + 0.5) / around;
      sum += f(vec3(s * std::cos(phi), s * std::sin(phi), z));
    }
  }
  return sum * 4.0 * kPiD / (up * around);
}

std::vector<vec3> someDirections() {
  std::vector<vec3> out;
  for (int i = 0; i < 60; ++i) {  // Fibonacci sphere
    const float z = 1.0f - 2.0f * (static_cast<float>(i) + 0.5f) / 60.0f;
    const float s = std::sqrt(1.0f - z * z), phi = 2.39996323f * static_cast<float>(i);
    out.emplace_back(s * std::cos(phi), s * std::sin(phi), z);
  }
  return out;
}

TEST(SphericalHarmonics, AreOrthonormal) {
  for (size_t i = 0; i < kShCoefficients; ++i)
    for (size_t j = i; j < kShCoefficients; ++j)
      EXPECT_NEAR(integrate([&](const vec3& d) {
                    const ShVector y = shBasis(d);
                    return double{y[i]} * double{y[j]};
                  }),
                  i == j ? 1.0 : 0.0, 2e-4)
          << i << ", " << j;
}

// Σₘ Yₗₘ(a) Yₗₘ(b) = (2l + 1)/4π · Pₗ(a·b). It is sensitive to the signs and the order within a
// band.
TEST(SphericalHarmonics, ObeyTheAdditionTheorem) {
  const auto legendre = [](int l, double x) {
    const double x2 = x * x;
    switch (l) {
      case 0:
        return 1.0;
      case 1:
        return x;
      case 2:
        return 0.5 * (3.0 * x2 - 1.0);
      case 3:
        return 0.5 * x * (5.0 * x2 - 3.0);
      default:
        return 0.125 * (x2 * (35.0 * x2 - 30.0) + 3.0);
    }
  };
  const std::vector<vec3> directions = someDirections();
  for (size_t i = 0; i < directions.size(); ++i) {
    const vec3 &a = directions[i], &b = directions[(i * 7 + 3) % directions.size()];
    const ShVector ya = shBasis(a), yb = shBasis(b);
    for (int l = 0; l < kShBands; ++l) {
      double sum = 0.0;
      for (int m = -l; m <= l; ++m) {
        const auto at = static_cast<size_t>(shIndex(l, m));
        sum += double{ya[at]} * double{yb[at]};
      }
      EXPECT_NEAR(sum, (2 * l + 1) / (4.0 * kPiD) * legendre(l, glm::dot(a, b)), 1e-5);
    }
  }
}

TEST(SphericalHarmonics, OfBandOneAreTheAxes) {
  const float c = std::sqrt(3.0f / (4.0f * kPi));
  const ShVector y = shBasis(glm::normalize(vec3(0.2f, -0.5f, 0.7f)));
  const vec3 d = glm::normalize(vec3(0.2f, -0.5f, 0.7f));
  EXPECT_NEAR(y[shIndex(1, -1)], c * d.y, 1e-6f);
  EXPECT_NEAR(y[shIndex(1, 0)], c * d.z, 1e-6f);
  EXPECT_NEAR(y[shIndex(1, 1)], c * d.x, 1e-6f);
}

// The factors are 2π ∫₀¹ Pₗ(x) x dx.
TEST(CosineTransfer, IsTheProjectionOfTheClampedCosine) {
  for (const vec3& n : {vec3(0, 0, 1), glm::normalize(vec3(0.3f, -0.8f, 0.5f))}) {
    const ShVector expected = cosineTransfer(n);
    for (size_t i = 0; i < kShCoefficients; ++i)
      EXPECT_NEAR(integrate(
                      [&](const vec3& d) {
                        return std::max(0.0, double{glm::dot(n, d)}) * double{shBasis(d)[i]};
                      },
                      1000, 512),
                  expected[i], 2e-4)
          << i;
  }
}

// Environments that contain only bands up to 4 are integrated without truncation.
TEST(CosineTransfer, GivesIrradianceOfConstantAndLinearLight) {
  ShVector constant{};
  constant[0] = std::sqrt(4.0f * kPi);  // L = 1
  for (const vec3& n : someDirections()) {
    EXPECT_NEAR(shDot(cosineTransfer(n), constant), kPi, 1e-5f);
    // L = 1 + a·ω: E = π + 2π/3 a·n.
    const vec3 a(0.3f, 0.4f, -0.5f);
    ShVector linear = constant;
    const float c = std::sqrt(4.0f * kPi / 3.0f);
    linear[shIndex(1, -1)] = c * a.y;
    linear[shIndex(1, 0)] = c * a.z;
    linear[shIndex(1, 1)] = c * a.x;
    EXPECT_NEAR(shDot(cosineTransfer(n), linear), kPi + 2.0f * kPi / 3.0f * glm::dot(a, n), 1e-5f);
  }
}

// A distant light of unit irradiance gives max(0, cos θ), except for the truncated bands 6, 8, …
TEST(CosineTransfer, GivesIrradianceOfADistantLightUpToTruncation) {
  const vec3 light = glm::normalize(vec3(-0.4f, 0.8f, 0.3f));
  const Frame frame(light);
  const ShVector radiance = shBasis(light);
  double worst = 0.0, squares = 0.0;
  constexpr int kSteps = 1800;
  for (int i = 0; i <= kSteps; ++i) {
    const double theta = kPiD * i / kSteps;
    const vec3 n = frame.toWorld(vec3(std::sin(theta), 0.0, std::cos(theta)));
    const double error =
        double{shDot(cosineTransfer(n), radiance)} - std::max(0.0, std::cos(theta));
    worst = std::max(worst, std::abs(error));
    squares += error * error * std::sin(theta) * kPiD / kSteps;
  }
  // Series of max(0, x) in Pₗ to l = 4: 1/4 + x/2 + 5/16 P₂ − 3/32 P₄. At x = 0 that is
  // 1/4 − 5/32 − 9/256 = 15/256.
  EXPECT_NEAR(worst, 15.0 / 256.0, 1e-4);
  // The remainder of ∫ max(0, x)² dx = 1/3 by Parseval, with 2/(2l + 1) cₗ² per band.
  const double left = 1.0 / 3.0 - (2.0 / 16.0 + 2.0 / 3.0 / 4.0 + 2.0 / 5.0 * 25.0 / 256.0 +
                                   2.0 / 9.0 * 9.0 / 1024.0);
  EXPECT_NEAR(squares, left, 1e-5);
}

}  // namespace
}  // namespace lamplighter
