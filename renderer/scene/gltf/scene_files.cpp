#include "renderer/scene/gltf/scene_files.h"

#include <sys/stat.h>

#include "renderer/scene/gltf/gltf_source.h"
#include "renderer/scene/scene.h"

namespace lamplighter {

FileStamp stampOf(const std::filesystem::path& path) {
  FileStamp stamp{path};
  struct stat now {};
  if (::stat(path.c_str(), &now) != 0) return stamp;
  stamp.size = static_cast<uint64_t>(now.st_size);
  stamp.modified = int64_t{now.st_mtim.tv_sec} * 1'000'000'000 + now.st_mtim.tv_nsec;
  return stamp;
}

std::vector<FileStamp> filesOf(const Scene& scene) {
  if (!scene.source || !scene.source->document.files) return {};
  return *scene.source->document.files;
}

}  // namespace lamplighter
