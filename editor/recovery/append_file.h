// Files of the journal: lines that are on the disk when they are written, and a lock that ends with
// its process however that ends.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace lamplighter {

class AppendFile {
 public:
  AppendFile() = default;
  // Begins the file; throws InputError.
  explicit AppendFile(const std::filesystem::path& path);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  bool isOpen() const { return descriptor_ >= 0; }
  // On the disk when this returns. Throws InputError with the file as it was.
  void append(std::string_view text);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  int64_t size_ = 0;
};

class FileLock {
 public:
  FileLock() = default;
  // Holds it from now on, or not: somebody else does. The file is made where it is not there.
  explicit FileLock(const std::filesystem::path& path);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

// What was renamed or made in a folder stays so after a power failure.
void syncFolder(const std::filesystem::path& folder);

}  // namespace lamplighter
