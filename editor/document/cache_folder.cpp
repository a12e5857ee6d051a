#include "editor/document/cache_folder.h"

#include <cstdlib>

namespace lamplighter {

namespace {

// The path in a variable; relative paths are invalid by the specification, and are ignored.
std::filesystem::path absolute(const char* variable) {
  const char* value = std::getenv(variable);
  const std::filesystem::path path(value != nullptr ? value : "");
  return path.is_absolute() ? path : std::filesystem::path();
}

std::filesystem::path folder(const char* variable, const char* below) {
  std::filesystem::path base = absolute(variable);
  if (base.empty()) {
    base = absolute("HOME");
    if (base.empty()) return {};
    base /= below;
  }
  return base / "lamplighter";
}

std::filesystem::path cache(const char* name) {
  const std::filesystem::path base = folder("XDG_CACHE_HOME", ".cache");
  return base.empty() ? base : base / name;
}

}  // namespace

std::filesystem::path configFolder() { return folder("XDG_CONFIG_HOME", ".config"); }
std::filesystem::path transferFolder() { return cache("transfer"); }
std::filesystem::path thumbnailFolder() { return cache("thumbnails"); }

}  // namespace lamplighter
