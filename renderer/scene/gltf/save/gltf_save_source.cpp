// Saves the source file of a scene as a single file.
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

void saveSource(const Scene& scene, const std::filesystem::path& glb) {
  try {
    GltfOutput out(scene, glb);
    out.startBuffers();
    out.carryImages();
    writeFilesAtomically(out.finish());
  } catch (const Json::exception& e) {
    throw InputError(
        glb.string(),
        "cannot be written: its source file is malformed (" + printable(e.what()) + ")",
        "save the level");
  }
}

}  // namespace lamplighter
