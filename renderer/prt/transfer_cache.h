// Transfer on disk, keyed by the data it was computed from. An object needs one computation for all
// scenes and positions.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "renderer/prt/transfer.h"

namespace lamplighter {

// A hash of everything that a transfer depends on: shape, normals, albedo with its texture, alpha
// mask, options, and the version of the computation.
using TransferKey = std::array<uint64_t, 2>;
TransferKey transferKey(const RenderScene& own, const TransferOptions& options);

// One file per transfer in a separate folder. No file is trusted: one that is damaged, truncated,
// of another version or of another object counts as missing.
class TransferCache {
 public:
  // An empty path: nothing is saved. The folder is created by the first save().
  explicit TransferCache(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  // vertices: of the object; a file with another number belongs to another object.
  std::optional<Transfer> load(const TransferKey& key, size_t vertices) const;
  // Writes under a temporary name first, so that no reader finds a partial file. Returns whether it
  // succeeded. A failure (disk full, no permission) is no error: the transfer is computed again
  // next time.
  bool save(const TransferKey& key, const Transfer& transfer) const;

  std::filesystem::path fileOf(const TransferKey& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lamplighter
