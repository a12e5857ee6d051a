// Writes all files of a saved scene, or none.
#include "renderer/base/atomic_file.h"
#include "renderer/base/error.h"
#include "renderer/scene/gltf/save/gltf_output.h"

namespace lamplighter {

void writeFilesAtomically(const std::vector<GltfOutput::File>& files) {
  std::vector<PendingFile> pending;
  pending.reserve(files.size());
  for (const GltfOutput::File& file : files) pending.emplace_back(file.path, file.bytes);
  try {
    for (PendingFile& file : pending) file.putInPlace();
  } catch (const InputError&) {
    for (PendingFile& file : pending) file.undo();
    throw;
  }
}

}  // namespace lamplighter
