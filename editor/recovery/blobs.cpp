#include "editor/recovery/blobs.h"

#include <fstream>

#include "editor/document/write_file.h"
#include "editor/input/recording.h"
#include "renderer/base/error.h"
#include "renderer/base/hash.h"

namespace lamplighter {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPrefix = "blob-";

}  // namespace

std::string Blobs::put(std::span<const uint8_t> bytes) {
  const std::string name =
      kPrefix + hashText(hashOfBytes(bytes)) + "-" + std::to_string(bytes.size());
  std::error_code error;
  if (fs::file_size(folder_ / name, error) == bytes.size() && !error) return name;
  fs::create_directories(folder_, error);
  writeFile(folder_ / name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  return name;
}

std::vector<uint8_t> Blobs::get(const std::string& name) const {
  // The name must not be a path to another folder.
  const bool isPlain = name.starts_with(kPrefix) && name.find('/') == std::string::npos;
  std::ifstream in(folder_ / name, std::ios::binary);
  std::vector<uint8_t> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const size_t dash = name.rfind('-');
  if (!isPlain || !in || name != kPrefix + hashText(hashOfBytes(bytes)) + name.substr(dash))
    throw InputError((folder_ / name).string(), "is missing or damaged",
                     "use the autosave beside it");
  return bytes;
}

}  // namespace lamplighter
