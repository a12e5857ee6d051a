// The journal of a killed process gives an InputError or a valid document.
#include "editor/recovery/recovery.h"
#include "renderer/base/error.h"
#include "renderer/scene/render_scene.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto folder = fuzz::scratch().path() / "root" / "session";
  std::filesystem::create_directories(folder);
  fuzz::scratch().write("root/session/journal.jsonl", fuzz::textOf(data, size));
  findRecoverable(folder.parent_path());
  try {
    const Recovered recovered = recover(folder);
    RenderScene world;
    update(world, recovered.document.scene, SceneChanges::all());
    documentHash(recovered.document);
  } catch (const InputError&) {
  }
  return 0;
}
