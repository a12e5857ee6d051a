#include "renderer/gl/scan.h"

#include <type_traits>

#include "shaders/shared/bindings.h"

namespace lamplighter::gl {

template <typename T>
void Scan<T>::reload(const std::filesystem::path& shaders) {
  const std::string type = std::is_same_v<T, float> ? "SCAN_TYPE float" : "SCAN_TYPE uint";
  ComputeProgram scan(shaders, "passes/scan.comp.glsl", {type});
  add_ = ComputeProgram(shaders, "passes/scan_add.comp.glsl", {type});
  scan_ = std::move(scan);
}

template <typename T>
void Scan<T>::run(const StorageBuffer<T>& values, size_t columns, size_t rows,
                  StorageBuffer<T>& sums) {
  run(values, columns, rows, sums, 0);
}

template <typename T>
void Scan<T>::run(const StorageBuffer<T>& values, size_t columns, size_t rows,
                  StorageBuffer<T>& sums, size_t level) {
  const size_t groups =
      std::max<size_t>((columns + shared::kScanGroup - 1) / shared::kScanGroup, 1);
  const auto row = static_cast<uint32_t>(rows);
  const auto width = static_cast<uint32_t>(columns);
  sums.resize(rows * (columns + 1));
  Level& above = levels_[level];
  above.groups.resize(groups == 1 ? 1 : rows * groups);
  values.bind(shared::kScanValues);
  sums.bind(shared::kScanSums);
  above.groups.bind(shared::kScanGroupSums);
  scan_.set(0, width);
  // A row without values has a total, too.
  scan_.dispatch({std::max(width, 1u), row, 1}, GL_SHADER_STORAGE_BARRIER_BIT);
  if (groups == 1) return;
  run(above.groups, groups, rows, above.offsets, level + 1);
  sums.bind(shared::kScanSums);
  above.offsets.bind(shared::kScanOffsets);
  add_.set(0, width);
  add_.set(1, static_cast<uint32_t>(groups));
  add_.dispatch({width + 1, row, 1}, GL_SHADER_STORAGE_BARRIER_BIT);
}

template class Scan<float>;
template class Scan<uint32_t>;

CdfPass::CdfPass(const std::filesystem::path& shaders)
    : scan_(shaders), divide_(shaders, "passes/cdf.comp.glsl") {}

void CdfPass::reload(const std::filesystem::path& shaders) {
  ComputeProgram divide(shaders, "passes/cdf.comp.glsl");
  scan_.reload(shaders);
  divide_ = std::move(divide);
}

void CdfPass::run(const StorageBuffer<float>& weights, size_t columns, size_t rows,
                  StorageBuffer<float>& cdf, StorageBuffer<float>& totals) {
  scan_.run(weights, columns, rows, sums_);
  cdf.resize(sums_.size());
  totals.resize(rows);
  sums_.bind(shared::kScanSums);
  cdf.bind(shared::kScanShares);
  totals.bind(shared::kScanTotals);
  const auto width = static_cast<uint32_t>(columns);
  divide_.set(0, width);
  divide_.dispatch({width + 1, static_cast<uint32_t>(rows), 1}, GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace lamplighter::gl
