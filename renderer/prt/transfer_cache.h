// Transfer on disk, keyed by the data it was computed from. An object needs one computation for all
// scenes and positions.
#pragma once

#include <filesystem>
#include <optional>

#include "renderer/base/content_cache.h"
#include "renderer/prt/transfer.h"

namespace lamplighter {

// A hash of everything that a transfer depends on: shape, normals, albedo with its texture, alpha
// mask and options.
using TransferKey = ContentKey;
TransferKey transferKey(const RenderScene& own, const TransferOptions& options);

// One file per transfer (ContentCache).
class TransferCache {
 public:
  // An empty path: nothing is saved. The folder is created by the first save().
  explicit TransferCache(std::filesystem::path folder = {});

  // vertices: of the object; a file with another number belongs to another object.
  std::optional<Transfer> load(const TransferKey& key, size_t vertices) const;
  // Returns whether it succeeded; if not, the transfer is computed again next time.
  bool save(const TransferKey& key, const Transfer& transfer) const;

  std::filesystem::path fileOf(const TransferKey& key) const { return files_.fileOf(key); }

 private:
  ContentCache files_;
};

}  // namespace lamplighter
