// Finds the files to which a glTF file refers.
#pragma once

#include <filesystem>
#include <vector>

#include "renderer/scene/gltf/scene_files.h"

namespace lamplighter {

// Stamps of the buffer and image files that a .gltf or .glb names, without reading them. Only files
// in its folder. Throws InputError if it is not glTF.
std::vector<FileStamp> referencedFiles(const std::filesystem::path& gltf);

}  // namespace lamplighter
