// The cost of highlights: frames with a moving camera in levels with metals and glazes, without and
// with speculars.
#include <filesystem>

#include <benchmark/benchmark.h>

#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/backend_benches.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

void frames(benchmark::State& state, const std::string& file, const MakeBackend& make,
            bool speculars) {
  const fs::path path = dataFolder() / "../shared" / "scenes" / file;
  if (!fs::exists(path)) {
    state.SkipWithError("the scene is not there");
    return;
  }
  const Scene scene = loadGltf(path).scene;
  View view;
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) view = viewOfCamera(scene, node, 640, 360);
  Settings settings;
  settings.set("vpls", 300);
  settings.set("updates", 300);
  settings.set("antialias", 1);
  settings.set("bias_compensation", false);
  settings.set("speculars", speculars);
  FrameRenderer renderer(make());
  const auto frame = [&](const SceneChanges& changes) {
    renderer.render({scene, changes, view, "many_lights", settings});
    renderer.backend().finish();
  };
  frame(SceneChanges::all());
  frame({});  // shaders are built on first use
  for (auto _ : state) {
    view.eye.x += 0.001f;
    frame({});
  }
}

}  // namespace

void addSpecularBenchmarks(const std::string& backend, const MakeBackend& make) {
  for (const std::string file : {"living-room/living-room.gltf", "modern-hall/modern-hall.glb"}) {
    for (const bool on : {false, true}) {
      const std::string name =
          "speculars/" + backend + "/" + fs::path(file).stem().string() + "/" + (on ? "on" : "off");
      benchmark::RegisterBenchmark(name.c_str(), frames, file, make, on)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime()
          ->MeasureProcessCPUTime();
    }
  }
}

}  // namespace lamplighter
