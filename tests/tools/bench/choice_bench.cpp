// What the choice of light samples costs: the stage `light samples` of a frame when a level is
// opened, and while a lamp or an object is dragged by five centimetres a frame. Milliseconds of
// processor time.
#include <ctime>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "editor/cli/options.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/ball.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

struct ChoiceCase {
  const char* scene;  // a path
  const char* node;   // "ball": a ball is added to the level
  const char* indirect = "samples";
};

// Of the processor, all threads together, so that other programs on the machine do not count.
double secondsNow() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

double lightSampleSeconds(const GiOutput& out) {
  double sum = 0.0;
  for (const auto& [stage, time] : out.stats.stageSeconds)
    if (stage.name == std::string("light samples")) sum += time;
  return sum;
}

void choose(benchmark::State& state, const ChoiceCase& c) {
  const fs::path path = dataFolder() / c.scene;
  if (!fs::exists(path)) return state.SkipWithError("the scene is not there");
  Scene scene = loadGltf(path).scene;
  const View view = cli::chooseView(scene, "", 320, 180);
  if (c.node == std::string("ball")) addBall(scene);
  Node* dragged = nullptr;
  for (Node& node : scene.nodes)
    if (node.name == c.node) dragged = &node;
  if (dragged == nullptr) return state.SkipWithError("the node is not there");
  Settings settings;
  settings.set("indirect", std::string(c.indirect));
  FrameRenderer renderer(makeCpuBackend(), secondsNow, StageTimes::exact);
  const auto frame = [&](const SceneChanges& changes) {
    return renderer.render({scene, changes, view, "many_lights", settings});
  };
  const double opened = lightSampleSeconds(frame(SceneChanges::all()));
  for (int i = 0; i < 10; ++i) frame({});
  double dragging = 0.0, walked = 0.0, shown = 0.0, all = 0.0;
  int steps = 0;
  for (auto _ : state) {
    const Scene before = scene;
    dragged->local.translation.x += (steps++ / 20) % 2 == 0 ? 0.05f : -0.05f;
    const double start = secondsNow();
    const GiOutput out = frame(compare(before, scene));
    all += secondsNow() - start;
    dragging += lightSampleSeconds(out);
    walked += out.stats.of("paths_walked");
    shown += out.stats.of("vpls");
  }
  const auto frames = static_cast<double>(state.iterations());
  state.counters["ms_opened"] = 1e3 * opened;
  state.counters["ms_dragged"] = 1e3 * dragging / frames;
  state.counters["ms_frame"] = 1e3 * all / frames;
  state.counters["walked"] = walked / frames;
  state.counters["vpls"] = shown / frames;
}

[[maybe_unused]] const bool kChoicesRegistered = [] {
  const char* zdm2 = "../shared/scenes/zdm2-map/zdm2.glb";
  const char* hall = "../shared/scenes/modern-hall/modern-hall.glb";
  const char* city = "../shared/scenes/candela-city/candela_city.glb";
  for (const auto& [name, c] :
       {std::pair("zdm2/ball", ChoiceCase{zdm2, "ball"}),
        {"modern_hall/ball", {hall, "ball"}},
        {"modern_hall/lamp", {hall, "rectangle_light_emit"}},
        {"default/lamp", {"assets/scenes/default.gltf", "warm ceiling light"}},
        {"default/ball", {"assets/scenes/default.gltf", "ball"}},
        {"corridor/lamp", {"assets/scenes/corridor.gltf", "lamp"}},
        {"candela_city/ball", {city, "ball", "meshes"}},
        {"candela_city/lamp", {city, "Lamp.001", "meshes"}}}) {
    benchmark::RegisterBenchmark((std::string("choice/") + name).c_str(), choose, c)
        ->Unit(benchmark::kMillisecond)
        ->Iterations(40);
  }
  return true;
}();

}  // namespace
}  // namespace lamplighter
