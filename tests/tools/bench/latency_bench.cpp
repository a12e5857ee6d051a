// Edit latency: a light or an object moves once, with the default budgets of the editor's window.
// Measures frames and milliseconds until the picture is within 50, 95 and 99% of the settled one.
// Each iteration is one edit; the direction alternates.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <string>

#include <benchmark/benchmark.h>

#include "editor/latency/edit_latency.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/frame_time_control.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr float kStep = 0.5f;  // metres

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

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
  FrameRenderer renderer(backend == "cpu" ? makeCpuBackend() : makeGlBackend(), seconds);
  const Settings settings;
  FrameTimeControl control;
  EditLatency latency;
  const auto frame = [&](const SceneChanges& changes) {
    Settings now = settings;
    const double budget = 1e-3 * frameBudgetParameters().read(settings).frameTime;
    now.set("updates", std::min(frameBudgetParameters().read(settings).updates,
                                control.updatesWithin(budget)));
    const double begin = seconds();
    const GiOutput out = renderer.render({scene, changes, view, "many_lights", now});
    renderer.backend().finish();
    control.measured(out.stats);
    latency.frame({!changes.none() && !changes.everything, moved, out.settled, view, out.radiance,
                   begin, seconds()});
    return out.settled;
  };
  bool settled = frame(SceneChanges::all());
  while (!settled) settled = frame({});

  int edits = 0;
  for (auto _ : state) {
    const Scene before = scene;
    node->local.translation.x += edits++ % 2 == 0 ? kStep : -kStep;
    settled = frame(compare(before, scene));
    while (!settled) settled = frame({});
  }
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
