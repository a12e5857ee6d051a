// File access of the journal: writes that are on the disk when they return, and a lock that ends
// with its process, even after a crash.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>
#include <utility>

namespace lamplighter {

// An open file of the system, closed at the end.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  Descriptor& operator=(Descriptor&& other) noexcept {
    std::swap(number_, other.number_);
    return *this;
  }
  ~Descriptor();
  explicit operator bool() const { return number_ >= 0; }
  int number() const { return number_; }

 private:
  int number_ = -1;
};

class AppendFile {
 public:
  AppendFile() = default;
  // Creates the file. Throws InputError.
  explicit AppendFile(const std::filesystem::path& path);

  bool isOpen() const { return static_cast<bool>(file_); }
  // The text is on the disk when this returns. On failure, restores the file and throws InputError.
  void append(std::string_view text);

 private:
  std::filesystem::path path_;
  Descriptor file_;
  int64_t size_ = 0;
};

class FileLock {
 public:
  FileLock() = default;
  // Tries to take the lock; fails if another process has it. Creates the file if it does not exist.
  explicit FileLock(const std::filesystem::path& path);
  explicit operator bool() const { return static_cast<bool>(file_); }

 private:
  Descriptor file_;
};

// Makes renamed and new files in a folder survive a power failure.
void syncFolder(const std::filesystem::path& folder);

}  // namespace lamplighter
