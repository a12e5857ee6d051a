// Files that are there as a whole or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace lamplighter {

// A file in the making, under another name beside its place: on the disk once it is made, in its
// place once it is put there, gone if it is not. Errors are InputError with what was there as it
// was.
class PendingFile {
 public:
  // Refuses to replace what is no regular file or is write-protected.
  PendingFile(const std::filesystem::path& target, std::span<const uint8_t> bytes);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  void putInPlace();
  void undo();  // what was replaced is there again, as long as this object is

 private:
  void writeAll(int descriptor, std::span<const uint8_t> bytes) const;

  std::filesystem::path target_, temporary_, backup_;
  bool isInPlace_ = false;
};

// One file at once.
void writeWhole(const std::filesystem::path& target, std::span<const uint8_t> bytes);

}  // namespace lamplighter
