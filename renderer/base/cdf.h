// Prefix sums, and sampling by inverting a cumulative distribution (CDF). Close numbers give close
// results, so that low-discrepancy points stay well distributed; alias_table.h is faster, but does
// not keep close numbers close. Serial, summed in double precision: the same bits on every machine.
// The gl backend has the same in compute shaders (renderer/gl/scan.h).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/math.h"

namespace lamplighter {

// out[i] = Σ values[j], j < i; one more entry than values, so that the last is the total.
std::vector<uint32_t> exclusiveScan(std::span<const uint32_t> values);
std::vector<float> exclusiveScan(std::span<const float> values);

// Samples an entry by weight.
class Cdf {
 public:
  Cdf() = default;
  explicit Cdf(std::span<const float> weights);  // ≥ 0, finite

  struct Sample {
    size_t index = 0;
    float within = 0.0f;  // the unused part of u, uniform in [0, 1)
    float probability = 0.0f;
  };
  bool empty() const { return values_.empty(); }  // also if all weights are 0
  double total() const { return total_; }         // of the weights
  Sample sample(float u) const;                   // not if empty()
  float probability(size_t i) const { return values_[i + 1] - values_[i]; }
  // From 0 to 1; one more entry than weights.
  std::span<const float> values() const { return values_; }

 private:
  std::vector<float> values_;
  double total_ = 0.0;
};

// Samples a cell of a grid by weight: a row, then a cell within it.
class GridCdf {
 public:
  GridCdf() = default;
  GridCdf(int width, int height, const std::vector<float>& weights);  // ≥ 0, finite, row by row

  struct Cell {
    int x = 0, y = 0;
    vec2 within{0.0f};  // the unused part of u, uniform in [0, 1)²
    float probability = 0.0f;
  };
  bool empty() const { return rows_.empty(); }  // also if all weights are 0
  Cell sample(vec2 u) const;                    // not if empty()
  float probability(int x, int y) const;

 private:
  int width_ = 0;
  Cdf rows_;
  std::vector<float> cells_;  // cumulative, starting with 0; width + 1 entries per row
};

}  // namespace lamplighter
