#include "renderer/base/alias_table.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {

AliasTable::AliasTable(std::span<const float> weights) {
  double sum = 0.0;
  for (const float w : weights) sum += static_cast<double>(w);
  if (!(sum > 0.0) || !std::isfinite(sum)) return;

  bins_.resize(weights.size());
  // Each entry's share of n bins; small shares are filled up by large ones (Vose).
  std::vector<double> share(weights.size());
  std::vector<uint32_t> poor, rich;
  for (uint32_t i = 0; i < weights.size(); ++i) {
    const double p = static_cast<double>(weights[i]) / sum;
    bins_[i].p = static_cast<float>(p);
    share[i] = p * static_cast<double>(weights.size());
    (share[i] < 1.0 ? poor : rich).push_back(i);
  }
  while (!poor.empty() && !rich.empty()) {
    const uint32_t p = poor.back(), r = rich.back();
    poor.pop_back();
    bins_[p].q = static_cast<float>(share[p]);
    bins_[p].alias = r;
    share[r] -= 1.0 - share[p];
    if (share[r] < 1.0) {
      rich.pop_back();
      poor.push_back(r);
    }
  }
  for (const auto* rest : {&poor, &rich}) {  // exactly 1, except for rounding errors
    for (const uint32_t i : *rest) {
      bins_[i].q = 1.0f;
      bins_[i].alias = i;
    }
  }
  // Because of rounding errors, an entry of weight zero could be sampled; prevent that.
  const auto heaviest =
      static_cast<uint32_t>(std::max_element(weights.begin(), weights.end()) - weights.begin());
  for (uint32_t i = 0; i < bins_.size(); ++i) {
    if (bins_[i].p > 0.0f) continue;
    bins_[i].q = 0.0f;
    if (bins_[i].alias == i) bins_[i].alias = heaviest;
  }
}

size_t AliasTable::sample(float u, float& remapped) const {
  constexpr float kBelowOne = 0x1.fffffep-1f;
  const float scaled = u * static_cast<float>(bins_.size());
  const size_t i = std::min(static_cast<size_t>(scaled), bins_.size() - 1);
  const float f = std::min(scaled - static_cast<float>(i), kBelowOne);
  const Bin& bin = bins_[i];
  if (f < bin.q) {
    remapped = std::min(f / bin.q, kBelowOne);
    return i;
  }
  remapped = std::min((f - bin.q) / (1.0f - bin.q), kBelowOne);
  return bin.alias;
}

}  // namespace lamplighter
