// glTF 2.0 in and out.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Told how far a load has come, in [0, 1], and at what; called from the loading thread. Returning
// false stops the load, which then throws InputError "cancelled".
using LoadProgress = std::function<bool(float done, const std::string& what)>;

struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  // each one line, "FILE: …", for standard error and the status
  std::vector<std::string> extensions;  // the file's extensionsUsed
};

// Reads .gltf or .glb, told apart by content. Throws InputError ("FILE: what is wrong and where;
// what to do") for anything that is no sound scene; a texture that cannot be decoded becomes a
// placeholder and a warning. A scene without any light gets kDefaultSky and a warning. Reads
// nothing outside the file's folder and never a network.
LoadedScene loadGltf(const std::filesystem::path& path, const LoadProgress& progress = {});

// Writes .gltf (with a .bin beside it) or .glb, by the ending, atomically: to a temporary file
// first, then renamed. What the source file held that Scene does not know is written again. Throws
// InputError when it cannot be written; then nothing has changed on disk. Returns the files that
// were written. Not `besideSource`: refers to none of the source's files, though they lie beside
// it; somebody may have changed them.
std::vector<std::filesystem::path> saveGltf(const Scene& scene, const std::filesystem::path& path,
                                            bool besideSource = true);

// The file that the scene came from with all bytes that its lists refer to, as one .glb: loading it
// gives the same meshes, textures and cameras at the same places. Edits are not in it. Throws
// InputError.
void saveSource(const Scene& scene, const std::filesystem::path& glb);

}  // namespace lamplighter
