// .gltf and .glb files give either an InputError of one line or a valid scene that can be rendered,
// saved and loaded again.
#include "renderer/base/error.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/fuzz/targets/scratch.h"

using namespace lamplighter;

namespace {

void checkSound(const Scene& s) {
  const auto within = [](int i, size_t n) { return i == kNone || (i >= 0 && size_t(i) < n); };
  for (const Node& n : s.nodes)
    if (!within(n.mesh, s.meshes.size()) || !within(n.camera, s.cameras.size()))
      fuzz::broken("a node's index");
  for (const auto& mesh : s.meshes) {
    for (const Primitive& p : mesh->primitives) {
      if (p.normals.size() != p.positions.size()) fuzz::broken("a normal for each position");
      for (const uint32_t i : p.indices)
        if (i >= p.positions.size()) fuzz::broken("a vertex index");
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const auto file = fuzz::scratch().write("scene.gltf", fuzz::textOf(data, size));
  LoadedScene loaded;
  try {
    loaded = loadGltf(file);
  } catch (const InputError& e) {
    if (std::string_view(e.what()).find('\n') != std::string_view::npos)
      fuzz::broken("a message of one line");
    return 0;
  }
  checkSound(loaded.scene);
  RenderScene world;
  update(world, loaded.scene, SceneChanges::all());
  const auto again = fuzz::scratch().path() / "again.glb";
  try {
    saveGltf(loaded.scene, again);
  } catch (const InputError&) {
    return 0;  // saving a scene with a malformed source may be refused
  }
  const LoadedScene second = loadGltf(again);  // an exception here is a bug
  if (second.scene.nodes.size() != loaded.scene.nodes.size()) fuzz::broken("as many nodes again");
  return 0;
}
