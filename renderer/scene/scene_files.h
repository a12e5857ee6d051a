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

// The file that the scene came from with all bytes that its lists refer to, as one .glb: loading it
// gives the same meshes, textures and cameras at the same places. Edits are not in it. Throws
// InputError.
void saveSource(const Scene& scene, const std::filesystem::path& glb);

}  // namespace lamplighter
