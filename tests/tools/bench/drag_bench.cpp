// Dragging: a light or an object moves by a few centimetres in every frame. The budgets are the
// defaults of the editor's window, or 100 updates per frame at any cost. At the end it is released.
#include <algorithm>
#include <chrono>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "editor/cli/options.h"
#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/frame_time_control.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/ball.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

struct Case {
  std::string scene;  // a path
  const char* node;   // "ball": a ball is added to the level
  const char* technique;
  const char* backend;
  int width = 640, height = 360;
  bool byTime = true;  // otherwise 100 updates per frame
  bool prt = false;    // precomputed transfer is on for the mover, which is complex
  int vpls = 300;
  int maps = ManyLightsParameters().mapResolution;  // texels per side
  const char* indirect = "automatic";
  int bounces = 2;
};

std::string roomPath(const std::string& name) { return "assets/scenes/" + name + ".gltf"; }

std::unique_ptr<Backend> backendOf(const std::string& name) {
  if (name == "cpu") return makeCpuBackend();
  return makeGlBackend(dataFolder() / "shaders");
}

void drag(benchmark::State& state, const Case& c) {
  const fs::path path = dataFolder() / c.scene;
  if (!fs::exists(path)) return state.SkipWithError("the scene is not there");
  Scene scene = loadGltf(path).scene;
  const View view = cli::chooseView(scene, "", c.width, c.height);
  if (c.node == std::string("ball")) addBall(scene);
  Node* dragged = nullptr;
  for (Node& node : scene.nodes)
    if (node.name == c.node) dragged = &node;
  Settings settings;
  settings.set("vpls", c.vpls);
  settings.set("map_resolution", c.maps);
  settings.set("technique", std::string(c.technique));
  settings.set("antialias", 1);
  settings.set("prt", c.prt);
  settings.set("indirect", std::string(c.indirect));
  settings.set("bounces", c.bounces);
  FrameRenderer renderer(backendOf(c.backend), seconds, StageTimes::exact);
  FrameTimeControl control;
  const double milliseconds = frameBudgetParameters().read(settings).frameTime;
  const auto frame = [&](const SceneChanges& changes) {
    Settings now = settings;
    FrameTimeControl::Work fit{.updates = 100};
    if (c.byTime) fit = control.within(1e-3 * milliseconds);
    now.set("updates", std::min(frameBudgetParameters().read(settings).updates, fit.updates));
    GiOutput out = renderer.render(
        {scene, changes, view, "many_lights", now, false, {.surfaceWork = fit.surfaces}});
    control.measured(out.stats);
    return out;
  };
  frame(SceneChanges::all());
  while (!frame({}).settled) {
  }
  int steps = 0;
  const auto step = [&] {
    const Scene before = scene;
    dragged->local.translation.x += (steps++ / 20) % 2 == 0 ? 0.05f : -0.05f;
    return frame(compare(before, scene));
  };
  double refreshed = 0.0, kept = 0.0, replaced = 0.0, pending = 0.0;
  std::map<std::string, double> stages;
  for (auto _ : state) {
    const GiOutput out = step();
    refreshed += out.stats.of("vpls_refreshed");
    kept += out.stats.of("paths_kept");
    replaced += out.stats.of("paths_replaced");
    pending += out.stats.of("vpls_pending");
    for (const auto& [stage, time] : out.stats.stageSeconds)
      stages[std::string(stage.name)] += time;
  }
  std::vector<Image> after;
  for (int i = 0; i < 5; ++i) after.push_back(frame({}).radiance->pixels());
  GiOutput settled = frame({});
  while (!settled.settled) settled = frame({});
  const Image& truth = settled.radiance->pixels();
  state.counters["fps"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  const auto frames = static_cast<double>(state.iterations());
  state.counters["vpls_a_frame"] = refreshed / frames;
  state.counters["vpls_pending"] = pending / frames;
  state.counters["paths_kept"] = kept / frames;
  state.counters["paths_replaced"] = replaced / frames;
  state.counters["error_1"] = compareImages(after[0], truth).relRmse;
  state.counters["error_5"] = compareImages(after[4], truth).relRmse;
  for (const auto& [name, time] : stages) {
    std::string key = "ms_" + name;
    std::replace(key.begin(), key.end(), ' ', '_');
    state.counters[key] = 1e3 * time / frames;
  }
}

void add(const std::string& name, const Case& c) {
  benchmark::RegisterBenchmark(name.c_str(), drag, c)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(40)
      ->UseRealTime();
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const char* backend : {"cpu", "gl"}) {
    for (const char* technique : {"naive", "visibility", "light_maps"}) {
      for (const auto& [scene, node] :
           {std::pair("pillar_room", "ceiling light"), std::pair("pillar_room", "mover")}) {
        const Case c{roomPath(scene), node, technique, backend};
        const std::string name =
            std::string("drag/") + scene + "/" + node + "/" + technique + "/" + backend;
        add(name, c);
      }
    }
    for (const char* node : {"ceiling light", "mover"}) {
      const Case c{roomPath("pillar_room"), node, "light_maps", backend, 640, 360, true, true};
      add(std::string("drag/pillar_room/") + node + "/light_maps+prt/" + backend, c);
    }
  }
  for (const auto& [width, height] : {std::pair(640, 360), std::pair(1024, 768)}) {
    const Case c{
        roomPath("pillar_room"), "ceiling light", "light_maps", "cpu", width, height, false};
    add("drag_100/pillar_room/ceiling light/" + std::to_string(width) + "x" +
            std::to_string(height) + "/cpu",
        c);
  }
  for (const int maps : {128, 256}) {
    Case c{roomPath("pillar_room"), "ceiling light", "light_maps", "cpu", 640, 360, false};
    c.maps = maps;
    add("drag_maps/" + std::to_string(maps) + "/pillar_room/ceiling light/640x360/cpu", c);
  }
  for (const char* indirect : {"samples", "meshes", "links"}) {
    for (const auto& [scene, node] :
         {std::pair("pillar_room", "ceiling light"), {"corridor", "lamp"}, {"door_ajar", "lamp"}}) {
      Case c{roomPath(scene), node, "light_maps", "cpu"};
      c.indirect = indirect;
      c.bounces = 5;
      add(std::string("drag_5_bounces/") + scene + "/" + node + "/" + indirect + "/cpu", c);
    }
  }
  const Case knot{roomPath("pillar_room"), "mover", "light_maps", "cpu", 640, 360, false};
  add("drag_100/pillar_room/mover/640x360/cpu", knot);
  for (const auto& [name, path] :
       {std::pair("kenney", "../shared/scenes/kenney-fps-level/kenney-fps-level.gltf"),
        std::pair("zdm2", "../shared/scenes/zdm2-map/zdm2.glb")}) {
    const Case c{path, "ball", "light_maps", "cpu", 640, 360, false, false, 100};
    add(std::string("drag_100/") + name + "/ball/640x360/cpu", c);
  }
  return true;
}();

}  // namespace
}  // namespace lamplighter
