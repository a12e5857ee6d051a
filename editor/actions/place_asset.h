// Props of other files, put into the level.
#pragma once

#include <filesystem>

namespace lamplighter {

class Session;

// As one step, or within the open one: on the surface in the middle of the view, selected. What the
// level has of it already (meshes, materials, textures) is shared. Throws InputError.
void placeAsset(Session& session, const std::filesystem::path& file);

}  // namespace lamplighter
