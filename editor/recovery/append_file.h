// File access of the journal: writes that are on the disk when they return, and a lock that ends
// with its process, even after a crash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

namespace lamplighter {

class AppendFile {
 public:
  AppendFile() = default;
  // Creates the file. Throws InputError.
  explicit AppendFile(const std::filesystem::path& path);
  AppendFile(AppendFile&& other) noexcept;
  AppendFile& operator=(AppendFile&& other) noexcept;
  ~AppendFile();

  bool isOpen() const { return descriptor_ >= 0; }
  // The text is on the disk when this returns. On failure, restores the file and throws InputError.
  void append(std::string_view text);

 private:
  std::filesystem::path path_;
  int descriptor_ = -1;
  int64_t size_ = 0;
};

class FileLock {
 public:
  FileLock() = default;
  // Tries to take the lock; fails if another process has it. Creates the file if it does not exist.
  explicit FileLock(const std::filesystem::path& path);
  FileLock(FileLock&& other) noexcept;
  FileLock& operator=(FileLock&& other) noexcept;
  ~FileLock();
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

// Makes renamed and new files in a folder survive a power failure.
void syncFolder(const std::filesystem::path& folder);

}  // namespace lamplighter
