#include "renderer/base/data_folder.h"

namespace lamplighter {

namespace fs = std::filesystem;

fs::path dataFolder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (!error) {
    const fs::path installed = program.parent_path().parent_path() / "share" / "lamplighter";
    if (fs::is_directory(installed / "shaders", error)) return installed;
  }
  return LAMPLIGHTER_SOURCE_DIR;
}

}  // namespace lamplighter
