// Places props from other glTF files in the level.
#pragma once

#include <filesystem>

namespace lamplighter {

class Session;

// Adds the asset on the surface at the centre of the view and selects it. This is one undo step, or
// part of the open transaction. Meshes, materials and textures that the level already has are
// shared. Throws InputError.
void placeAsset(Session& session, const std::filesystem::path& file);

}  // namespace lamplighter
