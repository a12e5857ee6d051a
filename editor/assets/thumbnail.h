// Small preview pictures of glTF files.
#pragma once

#include <filesystem>

#include "renderer/image/image.h"

namespace lamplighter {

// Renders the whole scene from slightly above, lit by a lamp at the camera, without a ground.
// Traces rays on the CPU: it needs no OpenGL and may run on any thread. Throws InputError.
Image8 renderThumbnail(const std::filesystem::path& file, int size);

// Returns the thumbnail from the cache folder, or renders it and stores it there. The cache has one
// PNG for each file and size, named by a hash of the file's bytes and the times of the files it
// references. A failed write to the cache is not an error. An empty folder disables the cache.
// Throws InputError.
Image8 cachedThumbnail(const std::filesystem::path& file, int size,
                       const std::filesystem::path& cacheFolder);

}  // namespace lamplighter
