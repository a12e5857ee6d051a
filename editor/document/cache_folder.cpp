#include "editor/document/cache_folder.h"

#include <cstdlib>

namespace lamplighter {

std::filesystem::path transferFolder() {
  // Relative paths are invalid by the specification, and are ignored.
  const auto absolute = [](const char* variable) {
    const char* value = std::getenv(variable);
    const std::filesystem::path path(value != nullptr ? value : "");
    return path.is_absolute() ? path : std::filesystem::path();
  };
  std::filesystem::path base = absolute("XDG_CACHE_HOME");
  if (base.empty()) {
    base = absolute("HOME");
    if (base.empty()) return {};
    base /= ".cache";
  }
  return base / "lamplighter" / "transfer";
}

}  // namespace lamplighter
