// Which files a glTF file stands for besides itself.
#pragma once

#include <filesystem>
#include <vector>

#include "renderer/scene/gltf/scene_files.h"

namespace lamplighter {

// What a .gltf or .glb names as its buffers and images, as it is now, without reading any of it;
// none outside its folder. Throws InputError where it is no glTF.
std::vector<FileStamp> referencedFiles(const std::filesystem::path& gltf);

}  // namespace lamplighter
