// The light of the Cornell box jumps to its position in cornell_lightmoved. Measures the time until
// the live picture is within 10 and 5% of the picture of an independent renderer, without the time
// of the comparison. 512 × 384, 5 bounces, every light sample may change in the first frame.
#include <chrono>
#include <filesystem>
#include <limits>

#include <benchmark/benchmark.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 512, kHeight = 384;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void lightMoved(benchmark::State& state) {
  const fs::path folder = dataFolder() / "../shared" / "references";
  if (!fs::exists(folder)) {
    state.SkipWithError("there are no independent pictures");
    return;
  }
  const Image truth = readImage(folder / "refs/cornell_lightmoved_b5.exr");
  const Image mask = readImage(folder / "refs/cornell_lightmoved_mask.exr");
  const Scene from = loadGltf(folder / "scenes/cornell.gltf").scene;
  const Scene to = loadGltf(folder / "scenes/cornell_lightmoved.gltf").scene;
  View view;
  for (const Node& node : from.nodes)
    if (node.camera != kNone) view = viewOfCamera(from, node, kWidth, kHeight);

  const auto vpls = static_cast<int>(state.range(0));
  Settings settings;
  settings.set("vpls", vpls);
  settings.set("updates", vpls);
  settings.set("bounces", 5);
  // There is one lamp. It needs few direct samples; most samples are bounces.
  settings.set("direct_share", 0.15f);
  settings.set("importance", 2);
  settings.set("clamp_distance", 1.0f);

  double to10 = 0.0, to5 = 0.0, error = 0.0, firstError = 0.0;
  std::map<std::string, double> stages;
  for (auto _ : state) {
    FrameRenderer renderer(makeCpuBackend(), seconds);
    Scene scene = from;
    const auto frame = [&](const SceneChanges& changes) {
      GiOutput out = renderer.render({scene, changes, view, "many_lights", settings});
      renderer.backend().finish();
      return out;
    };
    GiOutput out = frame(SceneChanges::all());
    while (!out.settled) out = frame({});

    to10 = to5 = std::numeric_limits<double>::quiet_NaN();
    for (Node& node : scene.nodes)
      for (const Node& there : to.nodes)
        if (there.name == node.name) node.local = there.local;
    SceneChanges changes = compare(from, scene);
    double sinceEdit = 0.0;
    bool isFirst = true;
    do {
      const double start = seconds();
      out = frame(changes);
      sinceEdit += seconds() - start;
      changes = {};
      error = compareImages(out.radiance->pixels(), truth, &mask).relRmse;
      if (isFirst) firstError = error;
      isFirst = false;
      if (std::isnan(to10) && error <= 0.1) to10 = sinceEdit;
      if (std::isnan(to5) && error <= 0.05) to5 = sinceEdit;
      for (const auto& [stage, time] : out.stats.stageSeconds)
        stages[std::string(stage.name)] += time;
    } while (!out.settled);
    state.SetIterationTime(sinceEdit);
  }
  state.counters["s_to_10%"] = to10;
  state.counters["s_to_5%"] = to5;
  state.counters["first_error%"] = 100.0 * firstError;
  state.counters["error%"] = 100.0 * error;
  for (const auto& [stage, time] : stages)
    state.counters["ms " + stage] = 1e3 * time / static_cast<double>(state.iterations());
}
BENCHMARK(lightMoved)
    ->Name("light_moved/cpu")
    ->Arg(300)
    ->Arg(512)
    ->Arg(768)
    ->Arg(1024)
    ->Arg(1536)
    ->Iterations(3)
    ->UseManualTime()
    ->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace lamplighter
