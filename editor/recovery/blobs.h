// Bytes that are too many for a line of the journal: pasted meshes and pixels, pictures of skies.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace lamplighter {

// Each in a file of its own, named by what is in it, so that it is written once.
class Blobs {
 public:
  explicit Blobs(std::filesystem::path folder) : folder_(std::move(folder)) {}
  // On the disk when this returns. Throws InputError.
  std::string put(std::span<const uint8_t> bytes);
  std::vector<uint8_t> get(const std::string& name) const;  // throws InputError

 private:
  std::filesystem::path folder_;
};

}  // namespace lamplighter
