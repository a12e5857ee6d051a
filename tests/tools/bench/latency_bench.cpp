// Edit latency: a light or an object moves once, with the default budgets of the editor's window.
// Measures frames and milliseconds until the picture is within 50, 95 and 99% of the settled one.
// Each iteration is one edit; the direction alternates.
#include <algorithm>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/window_frames.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr float kStep = 0.5f;  // metres

void editLatency(benchmark::State& state, const std::string& scenePath, const std::string& moved,
                 const std::string& backend) {
  Scene scene = loadGltf(dataFolder() / "assets/scenes" / scenePath).scene;
  View view;
  Node* node = nullptr;
  for (Node& n : scene.nodes) {
    if (n.camera != kNone) view = viewOfCamera(scene, n, 640, 360);
    if (n.name == moved) node = &n;
  }
  if (node == nullptr) return state.SkipWithError("no such object");
  WindowFrames window(backend == "cpu" ? makeCpuBackend() : makeGlBackend());
  window.settle(scene, SceneChanges::all(), view);

  int edits = 0;
  for (auto _ : state) {
    const Scene before = scene;
    node->local.translation.x += edits++ % 2 == 0 ? kStep : -kStep;
    window.settle(scene, compare(before, scene), view, moved);
  }
  const EditLatency& latency = window.latency();
  const auto mean = [&](auto value) {
    double sum = 0.0;
    for (const LatencyResult& r : latency.results()) sum += value(r);
    return sum / std::max<double>(static_cast<double>(latency.results().size()), 1.0);
  };
  for (size_t i = 0; i < kLatencyPercents.size(); ++i) {
    const std::string percent = std::to_string(kLatencyPercents[i]);
    state.counters["frames_" + percent] =
        mean([i](const LatencyResult& r) { return static_cast<double>(r.within[i].frames); });
    state.counters["ms_" + percent] =
        mean([i](const LatencyResult& r) { return r.within[i].milliseconds; });
  }
  state.counters["frames_settled"] =
      mean([](const LatencyResult& r) { return static_cast<double>(r.settled.frames); });
  state.counters["ms_settled"] =
      mean([](const LatencyResult& r) { return r.settled.milliseconds; });
}

[[maybe_unused]] const bool kRegistered = [] {
  struct Case {
    const char *scene, *node;
  };
  for (const char* backend : {"cpu", "gl"}) {
    for (const Case& c : {Case{"pillar_room.gltf", "ceiling light"},
                          Case{"pillar_room.gltf", "mover"}, Case{"cornell_style.gltf", "lamp"}}) {
      const std::string name = std::string("latency/") + fs::path(c.scene).stem().string() + "/" +
                               c.node + "/" + backend;
      benchmark::RegisterBenchmark(name.c_str(), editLatency, std::string(c.scene),
                                   std::string(c.node), std::string(backend))
          ->Unit(benchmark::kMillisecond)
          ->Iterations(6)
          ->UseRealTime();
    }
  }
  return true;
}();

}  // namespace
}  // namespace lamplighter
