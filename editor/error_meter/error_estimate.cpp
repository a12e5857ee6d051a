#include "editor/error_meter/error_estimate.h"

#include <algorithm>
#include <cmath>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/error.h"

namespace lamplighter {
namespace {

// Shows as many decimals as the uncertainty justifies.
std::string percent(double share, double uncertainty) {
  const int decimals = uncertainty < 0.00095 ? 2 : uncertainty < 0.095 ? 1 : 0;
  return fmt::format("{:.{}f}%", 100.0 * share, decimals);
}

}  // namespace

std::string ErrorEstimate::text() const {
  if (samples == 0) return "?";
  if (!isKnown) return "below " + percent(atMost, atMost / 10);
  return percent(error, uncertainty) + " \u00b1 " + percent(uncertainty, uncertainty);
}

// L is the picture, R the true value, A = R + a and B = R + b the halves of the reference. a and b
// are independent, have mean 0 and the same distribution. With M = (A + B)/2,
//
//   E|L − M|² = (L − R)² + Var M   and   E[(A − B)²/4] = Var M,
//
// |L − M|² minus (A − B)²/4 therefore estimates (L − R)² without the noise of the reference. It
// equals the product of the differences from each half,
//
//   q = x y  with  x = L − A, y = L − B:
//   E q = (L − R)² − (L − R)(E a + E b) + E a E b = (L − R)².
//
// The difference of the halves gives the variance of q: with δ = L − R and s = Var a, Var q = 2δ²s
// + s², and w = (x² − y²)/2 = (b − a)δ + (a² − b²)/2 has E w² = 2δ²s + s² for Gaussian noise, and
// more for noise with heavy tails: w² is a conservative estimate. Channels of a block share their
// paths, so q and w are first summed over them. Blocks share no random numbers, so the result is a
// sum of independent terms:
//
//   MSE ≈ Σ q / n,   Var MSE ≈ Σ w² / n².
//
// The mean of the reference, which divides the error, is estimated in the same way.
ErrorEstimate estimateError(const Image& picture, const ReferenceHalves& reference) {
  const Image &a = reference.first, &b = reference.second;
  if (picture.width != a.width || picture.height != a.height)
    throw InputError("error meter", "the picture and the reference differ in size",
                     "compare pictures of one size");
  ErrorEstimate estimate;
  if (reference.samples == 0 || picture.empty()) return estimate;
  double sum = 0.0, sumVariance = 0.0, mean = 0.0, meanVariance = 0.0;
  size_t count = 0;
  for (size_t i = 0; i < picture.pixels.size(); ++i) {
    if (!reference.counts.empty() && reference.counts[i] == 0) continue;
    ++count;
    const glm::dvec3 x = glm::dvec3(picture.pixels[i]) - glm::dvec3(a.pixels[i]);
    const glm::dvec3 y = glm::dvec3(picture.pixels[i]) - glm::dvec3(b.pixels[i]);
    const double w = 0.5 * (glm::dot(x, x) - glm::dot(y, y));
    sum += glm::dot(x, y);
    sumVariance += w * w;
    const glm::dvec3 middle = 0.5 * (glm::dvec3(a.pixels[i]) + glm::dvec3(b.pixels[i]));
    const glm::dvec3 half = 0.5 * (x - y);
    mean += middle.r + middle.g + middle.b;
    meanVariance += std::pow(half.r + half.g + half.b, 2);
  }
  if (!(mean > 0.0)) return estimate;
  const double n = 3.0 * static_cast<double>(count);
  const double mse = sum / n, deviation = std::sqrt(sumVariance) / n;
  mean /= n;
  const double root = std::sqrt(std::max(mse, 0.0)) / mean;
  // If the error is small compared to its deviation, the square root is not linear there. The
  // uncertainty is half the interval of the root over one deviation to either side.
  const double high = std::sqrt(std::max(mse + deviation, 0.0)) / mean;
  const double low = std::sqrt(std::max(mse - deviation, 0.0)) / mean;
  const double ofMean = root * std::sqrt(meanVariance) / n / mean;
  estimate.error = root;
  estimate.uncertainty = std::hypot(0.5 * (high - low), ofMean);
  estimate.atMost = std::sqrt(std::max(mse, 0.0) + 2.0 * deviation) / mean + 2.0 * ofMean;
  estimate.samples = 2 * reference.samples;
  estimate.isKnown = mse > 2.0 * deviation;
  return estimate;
}

}  // namespace lamplighter
