// Writes files atomically: afterwards a file is either complete or unchanged.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <utility>

namespace lamplighter {

// A file that is written in two steps. The constructor writes it under a temporary name in the same
// folder; putInPlace() renames it to the target. The destructor deletes the temporary file if that
// did not happen. Errors throw InputError and do not change the previous file.
class PendingFile {
 public:
  // Refuses to replace a target that is not a regular file or is write-protected.
  PendingFile(const std::filesystem::path& target, std::span<const uint8_t> bytes);
  PendingFile(PendingFile&& other) noexcept;
  PendingFile& operator=(PendingFile&&) = delete;
  ~PendingFile();

  void putInPlace();
  void undo();  // restores the replaced file; possible while this object exists

 private:
  void writeAll(int descriptor, std::span<const uint8_t> bytes) const;

  std::filesystem::path target_, temporary_, backup_;
  bool isInPlace_ = false;
};

// Writes one file atomically.
void writeWhole(const std::filesystem::path& target, std::span<const uint8_t> bytes);

}  // namespace lamplighter
