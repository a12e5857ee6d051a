// Reads and writes glTF 2.0.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "renderer/scene/scene.h"

namespace lamplighter {

// Receives the progress of a load in [0, 1] and the present step; called from the loading thread.
// If it returns false, the load stops with InputError "cancelled".
using LoadProgress = std::function<bool(float done, const std::string& what)>;

struct LoadedScene {
  Scene scene;
  std::vector<std::string> warnings;  // one line each, "FILE: …", for standard error and the status
                                      // line
  std::vector<std::string> extensions;  // the file's extensionsUsed
};

// Reads .gltf or .glb, recognised by content. Throws InputError ("FILE: what is wrong and where;
// what to do") if the file is not a valid scene. A texture that cannot be decoded becomes a
// placeholder with a warning. A scene without any light gets kDefaultSky and a warning. Reads only
// files in the folder of the file, and never uses a network.
LoadedScene loadGltf(const std::filesystem::path& path, const LoadProgress& progress = {});

// Writes .gltf (with a .bin beside it) or .glb, depending on the extension. Atomic: writes
// temporary files, then renames them. Data of the source file that Scene does not represent is
// preserved. Throws InputError on failure; then nothing on disk has changed. Returns the written
// files. `besideSource` false: the result refers to no file of the source even if it is in the same
// folder, because those files may have changed.
std::vector<std::filesystem::path> saveGltf(const Scene& scene, const std::filesystem::path& path,
                                            bool besideSource = true);

// Writes the file from which the scene was loaded, with all referenced bytes, as one .glb. Loading
// it gives the same meshes, textures and cameras at the same indices. Does not contain edits.
// Throws InputError.
void saveSource(const Scene& scene, const std::filesystem::path& glb);

}  // namespace lamplighter
