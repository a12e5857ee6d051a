// Folders of the program for files of its user, by the XDG Base Directory Specification. The
// functions create nothing.
#pragma once

#include <filesystem>

namespace lamplighter {

// Settings and keys: $XDG_CONFIG_HOME/lamplighter, or ~/.config for the first part. Empty where
// there is neither.
std::filesystem::path configFolder();
// Data that can be computed again, in $XDG_CACHE_HOME/lamplighter, or ~/.cache for the first part:
// precomputed transfer, texel layouts and topologies of meshes, and thumbnails of the asset
// browser. Empty where there is neither.
std::filesystem::path transferFolder();
std::filesystem::path thumbnailFolder();

}  // namespace lamplighter
