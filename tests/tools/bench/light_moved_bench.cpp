// The light of the Cornell box jumps to its position in cornell_lightmoved. Measures the time until
// the live picture is within 10 and 5% of the picture of an independent renderer, without the time
// of the comparison. 512 × 384, 5 bounces, every light sample may change in the first frame.
#include <chrono>
#include <filesystem>
#include <limits>

#include <benchmark/benchmark.h>

#include "editor/convergence/convergence_meter.h"
#include "editor/convergence/scene_move.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

RenderSettings settingsOf(int vpls) {
  RenderSettings render;
  render.values.set("vpls", vpls);
  render.values.set("updates", vpls);
  render.values.set("frame_time", 0.0f);
  render.values.set("refine", 0);
  render.values.set("bounces", 5);
  render.values.set("indirect", std::string("samples"));
  // There is one lamp. It needs few direct samples; most samples are bounces.
  render.values.set("direct_share", 0.15f);
  render.values.set("importance", 2);
  render.values.set("clamp_distance", 1.0f);
  return render;
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
  const SceneMove move = moveTo(from, to);

  Convergence moved;
  std::map<std::string, double> stages;
  for (auto _ : state) {
    Session session(std::make_unique<FrameRenderer>(makeCpuBackend(), seconds));
    session.resizeViewport(truth.width, truth.height);
    session.editing().setInitialRender(settingsOf(static_cast<int>(state.range(0))));
    ConvergenceMeter meter(session, seconds);
    meter.measure([&] { session.open(from, {}, {}); }, nullptr);
    moved = meter.measure([&] { applyMove(session.editing(), move); },
                          [&](const Image& picture) { return relRmse(picture, truth, &mask); });
    for (const auto& [stage, time] : moved.stageSeconds) stages[stage] += time;
    state.SetIterationTime(*moved.settled);
  }
  constexpr double kNever = std::numeric_limits<double>::quiet_NaN();
  state.counters["s_to_10%"] = moved.secondsToStayBelow(0.1).value_or(kNever);
  state.counters["s_to_5%"] = moved.secondsToStayBelow(0.05).value_or(kNever);
  state.counters["first_error%"] = 100.0 * moved.curve.front().error;
  state.counters["error%"] = 100.0 * moved.curve.back().error;
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
