#include "editor/document/write_file.h"

#include "renderer/base/atomic_file.h"

namespace lamplighter {

void writeFile(const std::filesystem::path& path, std::string_view content) {
  writeWhole(path, {reinterpret_cast<const uint8_t*>(content.data()), content.size()});
}

}  // namespace lamplighter
