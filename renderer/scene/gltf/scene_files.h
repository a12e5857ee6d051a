// Which files a scene was read from, and whether somebody has changed them since.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace lamplighter {

struct Scene;

// A file as it was at some moment; what is not there has size and time 0.
struct FileStamp {
  std::filesystem::path path;
  uint64_t size = 0;
  int64_t modified = 0;  // ns, of the file system's clock
  bool operator==(const FileStamp&) const = default;
};

FileStamp stampOf(const std::filesystem::path& path);
// The scene's own file first, then its buffers, images, profiles and the like, each as it was just
// before it was read. Empty for a scene that came from no file.
std::vector<FileStamp> filesOf(const Scene& scene);

}  // namespace lamplighter
