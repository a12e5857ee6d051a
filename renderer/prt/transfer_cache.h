// Transfer on disk, by what it was computed of: once for an object, in whatever scene and wherever
// it stands.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "renderer/prt/transfer.h"

namespace lamplighter {

// A hash of all that a transfer depends on: shape, normals, albedo with its texture, alpha mask,
// options, and the version of the computation.
using TransferKey = std::array<uint64_t, 2>;
TransferKey transferKey(const RenderScene& own, const TransferOptions& options);

// One file a transfer in a folder of its own. Nothing in that folder is trusted: what is damaged,
// cut short, of another version or of another object counts as not there.
class TransferCache {
 public:
  // An empty path: nothing is kept. The folder is made when the first is saved.
  explicit TransferCache(std::filesystem::path folder = {}) : folder_(std::move(folder)) {}

  // vertices: of the object; a file with another number is of another one.
  std::optional<Transfer> load(const TransferKey& key, size_t vertices) const;
  // Under another name first, so that no one finds half of it. Whether it could; what stands in the
  // way (no room, no permission) is no error, it is computed again next time.
  bool save(const TransferKey& key, const Transfer& transfer) const;

  std::filesystem::path fileOf(const TransferKey& key) const;

 private:
  std::filesystem::path folder_;
};

}  // namespace lamplighter
