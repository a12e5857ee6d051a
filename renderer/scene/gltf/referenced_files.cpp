#include "renderer/scene/gltf/referenced_files.h"

#include <string>

#include "renderer/scene/gltf/gltf_document.h"

namespace lamplighter {

std::vector<FileStamp> referencedFiles(const std::filesystem::path& gltf) {
  const GltfDocument document = readGltfJson(gltf);
  std::vector<FileStamp> files;
  for (const char* list : {"buffers", "images"}) {
    const auto entries = document.json.find(list);
    if (entries == document.json.end() || !entries->is_array()) continue;
    for (const Json& entry : *entries) {
      if (!entry.is_object() || !entry.contains("uri") || !entry["uri"].is_string()) continue;
      const std::string uri = entry["uri"].get<std::string>();
      const auto name = std::filesystem::path(percentDecoded(uri)).lexically_normal();
      if (uri.starts_with("data:") || name.is_absolute() || name.string().starts_with(".."))
        continue;
      files.push_back(stampOf(gltf.parent_path() / name));
    }
  }
  return files;
}

}  // namespace lamplighter
