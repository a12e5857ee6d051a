// Data that is too large for a line of the journal: pasted meshes and pixels, pictures of skies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lamplighter {

// Stores each blob in its own file. The name is derived from the content, so each blob is written
// once.
class Blobs {
 public:
  explicit Blobs(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // The bytes are on the disk when this returns. Throws InputError.
  std::string put(std::span<const uint8_t> bytes);
  std::vector<uint8_t> get(const std::string& name) const;  // throws InputError

 private:
  std::filesystem::path folder_;
};

}  // namespace lamplighter
