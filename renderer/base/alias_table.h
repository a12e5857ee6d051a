// Samples a discrete distribution in constant time (Walker 1974, Vose 1991).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lamplighter {

class AliasTable {
 public:
  AliasTable() = default;
  // Weights must be ≥ 0, finite and not all zero; otherwise the table is empty.
  explicit AliasTable(std::span<const float> weights);

  bool empty() const { return bins_.empty(); }
  size_t size() const { return bins_.size(); }
  float probability(size_t i) const { return bins_[i].p; }
  // Returns an index for u in [0, 1). `remapped` gets the unused part of u, uniform in [0, 1)
  // again.
  size_t sample(float u, float& remapped) const;

 private:
  struct Bin {
    float p = 0.0f;  // probability of this entry
    float q = 0.0f;  // threshold within the bin
    uint32_t alias = 0;
  };
  std::vector<Bin> bins_;
};

}  // namespace lamplighter
