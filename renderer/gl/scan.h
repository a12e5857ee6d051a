// Prefix sums and cumulative distributions (CDFs) of storage buffers, in compute shaders: work
// groups scan their values, then the sums of the groups are scanned in the same way (Blelloch,
// "Prefix sums and their applications", 1990). The same bits each time. renderer/base/cdf.h is the
// same on the CPU; floats differ in their last bits, because that one adds in double precision.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>

#include "renderer/gl/program.h"
#include "renderer/gl/storage_buffer.h"

namespace lamplighter::gl {

// T: float or uint32_t.
template <typename T>
class Scan {
 public:
  // Throws ShaderError.
  explicit Scan(const std::filesystem::path& shaders) { reload(shaders); }
  void reload(const std::filesystem::path& shaders);

  // The sums before each value of `rows` rows of `columns` values, with the total at the end of
  // each row: columns + 1 entries per row. Shaders can read them afterwards.
  void run(const StorageBuffer<T>& values, size_t columns, size_t rows, StorageBuffer<T>& sums);

 private:
  void run(const StorageBuffer<T>& values, size_t columns, size_t rows, StorageBuffer<T>& sums,
           size_t level);

  ComputeProgram scan_, add_;
  struct Level {
    StorageBuffer<T> groups, offsets;
  };
  std::map<size_t, Level> levels_;  // sums of work groups, sums of groups of these, and so on
};

// The cumulative distributions of rows of weights.
class CdfPass {
 public:
  // Throws ShaderError.
  explicit CdfPass(const std::filesystem::path& shaders);
  void reload(const std::filesystem::path& shaders);

  // cdf: for each row the share of the weights before each one, from 0 to 1, columns + 1 entries;
  // uniform if all weights of the row are 0. totals: the sum of the weights of each row. For a
  // grid, a second run with the totals as one row gives the distribution of the rows. Shaders
  // sample it with shaders/common/cdf.glsl.
  void run(const StorageBuffer<float>& weights, size_t columns, size_t rows,
           StorageBuffer<float>& cdf, StorageBuffer<float>& totals);

 private:
  Scan<float> scan_;
  ComputeProgram divide_;
  StorageBuffer<float> sums_;
};

}  // namespace lamplighter::gl
