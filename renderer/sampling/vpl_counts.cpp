#include "renderer/sampling/vpl_counts.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

// Distributes `extra` over the counts of the shares in `open` by weight (largest remainder).
void addByWeight(std::span<const SampleShare> shares, const std::vector<size_t>& open, int extra,
                 std::vector<int>& counts) {
  double sum = 0.0;
  for (const size_t i : open) sum += shares[i].weight;
  if (extra <= 0 || !(sum > 0.0)) return;
  std::vector<std::pair<double, size_t>> remainders;
  int given = 0;
  for (const size_t i : open) {
    const double quota = extra * (shares[i].weight / sum);
    const int whole = static_cast<int>(std::floor(quota));
    counts[i] += whole;
    given += whole;
    remainders.emplace_back(quota - whole, i);
  }
  std::stable_sort(remainders.begin(), remainders.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (size_t k = 0; k < remainders.size() && given < extra; ++k, ++given) {
    ++counts[remainders[k].second];
  }
}

}  // namespace

float nearestPowerOfTwo(float v) {
  int exponent = 0;
  constexpr float kRootOfHalf = 0.70710678f;
  return std::ldexp(1.0f, std::frexp(v, &exponent) < kRootOfHalf ? exponent - 1 : exponent);
}

SampleCounts shareSamples(std::span<const SampleShare> shares, int total) {
  SampleCounts result;
  result.counts.assign(shares.size(), 0);
  std::vector<size_t> order;
  double all = 0.0;
  for (size_t i = 0; i < shares.size(); ++i) {
    if (!(shares[i].weight > 0.0f)) continue;
    order.push_back(i);
    all += shares[i].weight;
  }
  std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
    return shares[a].order != shares[b].order ? shares[a].order > shares[b].order
                                              : shares[a].weight > shares[b].weight;
  });

  int used = 0;
  double served = 0.0;
  std::vector<size_t> open;
  for (const size_t i : order) {
    if (total <= 0 || (used > 0 && used + shares[i].least > total)) break;
    used += result.counts[i] = shares[i].least;
    served += shares[i].weight;
    if (!shares[i].isFixed) open.push_back(i);
  }
  if (served > 0.0 && served < all) result.scale = static_cast<float>(all / served);
  std::sort(open.begin(), open.end());
  addByWeight(shares, open, total - used, result.counts);
  return result;
}

}  // namespace lamplighter
