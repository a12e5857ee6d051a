// What a glTF file looks like, small.
#pragma once

#include <filesystem>

#include "renderer/image/image.h"

namespace lamplighter {

// All of it from a little above, under a lamp at the camera, upon nothing. Made of rays on the
// processor: needs no OpenGL, and may run on any thread. Throws InputError.
Image8 renderThumbnail(const std::filesystem::path& file, int size);

// From the cache folder (one PNG a file and size, by a hash of the file's bytes and the times of
// those it names), or rendered and put there; a cache that cannot be written is no error. Empty
// folder: no cache. Throws InputError.
Image8 cachedThumbnail(const std::filesystem::path& file, int size,
                       const std::filesystem::path& cacheFolder);

}  // namespace lamplighter
