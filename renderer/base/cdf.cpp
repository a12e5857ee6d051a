#include "renderer/base/cdf.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

// Finds the interval of u among the cumulative values first[0 … count], from 0 to 1.
size_t findInterval(const float* first, size_t count, float u, float& within) {
  const float* above = std::upper_bound(first + 1, first + count, u);
  auto i = static_cast<size_t>(above - first) - 1;
  // Never selects an interval of zero width.
  while (i > 0 && !(first[i + 1] > first[i])) --i;
  while (i + 1 < count && !(first[i + 1] > first[i])) ++i;
  within = std::clamp((u - first[i]) / (first[i + 1] - first[i]), 0.0f, 0x1.fffffep-1f);
  return i;
}

// Appends the cumulative values of the weights, from 0 to 1, and returns the sum of the weights. If
// all weights are 0, the values are uniform.
double appendCumulative(std::span<const float> weights, std::vector<float>& out) {
  double total = 0.0;
  for (const float w : weights) total += static_cast<double>(w);
  double below = 0.0;
  out.push_back(0.0f);
  for (size_t i = 0; i < weights.size(); ++i) {
    below += static_cast<double>(weights[i]);
    out.push_back(total > 0.0 ? static_cast<float>(below / total)
                              : static_cast<float>(i + 1) / static_cast<float>(weights.size()));
  }
  if (!weights.empty()) out.back() = 1.0f;
  return total;
}

template <typename Sum, typename T>
std::vector<T> scan(std::span<const T> values) {
  std::vector<T> out(values.size() + 1);
  Sum sum{};
  for (size_t i = 0; i < values.size(); ++i) {
    out[i] = static_cast<T>(sum);
    sum += static_cast<Sum>(values[i]);
  }
  out.back() = static_cast<T>(sum);
  return out;
}

}  // namespace

std::vector<uint32_t> exclusiveScan(std::span<const uint32_t> values) {
  return scan<uint32_t>(values);
}

std::vector<float> exclusiveScan(std::span<const float> values) { return scan<double>(values); }

Cdf::Cdf(std::span<const float> weights) {
  total_ = appendCumulative(weights, values_);
  if (!(total_ > 0.0) || !std::isfinite(total_)) *this = Cdf();
}

Cdf::Sample Cdf::sample(float u) const {
  Sample sample;
  sample.index = findInterval(values_.data(), values_.size() - 1, u, sample.within);
  sample.probability = probability(sample.index);
  return sample;
}

GridCdf::GridCdf(int width, int height, const std::vector<float>& weights) : width_(width) {
  const auto columns = static_cast<size_t>(width);
  std::vector<float> rows;
  for (size_t y = 0; y < static_cast<size_t>(height); ++y) {
    const auto row = std::span(weights).subspan(y * columns, columns);
    rows.push_back(static_cast<float>(appendCumulative(row, cells_)));
  }
  rows_ = Cdf(rows);
  if (rows_.empty()) cells_.clear();
}

GridCdf::Cell GridCdf::sample(vec2 u) const {
  Cell cell;
  const Cdf::Sample row = rows_.sample(u.y);
  const auto columns = static_cast<size_t>(width_);
  const size_t column =
      findInterval(&cells_[row.index * (columns + 1)], columns, u.x, cell.within.x);
  cell.x = static_cast<int>(column);
  cell.y = static_cast<int>(row.index);
  cell.within.y = row.within;
  cell.probability = probability(cell.x, cell.y);
  return cell;
}

float GridCdf::probability(int x, int y) const {
  const float* row = &cells_[static_cast<size_t>(y) * (static_cast<size_t>(width_) + 1)];
  return rows_.probability(static_cast<size_t>(y)) * (row[x + 1] - row[x]);
}

}  // namespace lamplighter
