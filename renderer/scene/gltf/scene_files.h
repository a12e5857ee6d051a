// The files from which a scene was read, to detect changes by other programs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lamplighter {

struct Scene;

// State of a file at some time; a missing file has size and time 0.
struct FileStamp {
  std::filesystem::path path;
  uint64_t size = 0;
  int64_t modified = 0;  // [ns], clock of the file system
  bool operator==(const FileStamp&) const = default;
};

FileStamp stampOf(const std::filesystem::path& path);
// The scene's own file first, then its buffers, images, profiles etc., each with its stamp just
// before reading. Empty if the scene was not loaded from a file.
std::vector<FileStamp> filesOf(const Scene& scene);

}  // namespace lamplighter
