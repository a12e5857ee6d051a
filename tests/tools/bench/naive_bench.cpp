// The cost of `many_lights` with the technique `naive`: the scenes of paper 1, figure 5-1, over the
// number of VPLs (the baseline of figure 5-3), and the kernels alone.
#include <chrono>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "renderer/backends/many_lights_kernels.h"
#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/backend_benches.h"

namespace lamplighter {
namespace {

constexpr int kWidth = 640, kHeight = 360;
const char* const kScenes[] = {"area_light_room", "table_room", "pillar_room"};

struct Level {
  Scene scene;
  View view;
  NodeId mover = kNoNode;

  explicit Level(const std::string& name)
      : scene(loadGltf(dataFolder() / "assets" / "scenes" / (name + ".gltf")).scene) {
    for (const Node& node : scene.nodes) {
      if (node.camera != kNone) view = viewOfCamera(scene, node, kWidth, kHeight);
      if (node.name == "mover") mover = node.id;
    }
  }
};

Settings settingsOf(int vpls, int updates) {
  Settings settings;
  settings.set("vpls", vpls);
  settings.set("updates", updates);
  settings.set("bounces", 1);
  settings.set("indirect", std::string("samples"));  // as in the paper
  settings.set("antialias", 1);
  settings.set("technique", std::string("naive"));
  return settings;
}

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// The camera orbits: each frame computes the G-buffer and all sums again and keeps the shadow maps.
void cameraMoves(benchmark::State& state, const std::string& name, const MakeBackend& make) {
  const int vpls = static_cast<int>(state.range(0));
  Level level(name);
  FrameRenderer renderer(make());
  const Settings settings = settingsOf(vpls, vpls);
  const auto frame = [&](const SceneChanges& changes) {
    return renderer.render({level.scene, changes, level.view, "many_lights", settings});
  };
  double shown = frame(SceneChanges::all()).stats.of("vpls");
  for (auto _ : state) {
    level.view.eye.x += 0.001f;
    shown = frame({}).stats.of("vpls");
    renderer.backend().finish();
  }
  state.counters["vpls"] = shown;
}

// The mover moves: each frame also renders every shadow map that sees it and samples the bounced
// VPLs again.
void objectMoves(benchmark::State& state, const std::string& name, const MakeBackend& make) {
  const int vpls = static_cast<int>(state.range(0));
  Level level(name);
  FrameRenderer renderer(make());
  const Settings settings = settingsOf(vpls, vpls);
  const auto frame = [&](const SceneChanges& changes) {
    return renderer.render({level.scene, changes, level.view, "many_lights", settings});
  };
  frame(SceneChanges::all());
  SceneChanges moved;
  moved.moved = {level.mover};
  double maps = 0.0;
  float step = 0.01f;
  for (auto _ : state) {
    level.scene.find(level.mover)->local.translation.x += step;
    step = -step;
    maps = frame(moved).stats.of("maps_rendered");
    renderer.backend().finish();
  }
  state.counters["maps"] = maps;
}

// On one scene: nanoseconds per light and pixel for the sum alone, and shadow maps per second.
void kernels(benchmark::State& state, const std::string& name, const MakeBackend& make) {
  Level level(name);
  FrameRenderer renderer(make(), seconds, StageTimes::exact);
  const int vpls = static_cast<int>(state.range(0));
  const Settings settings = settingsOf(vpls, vpls);
  SceneChanges moved;
  moved.moved = {level.mover};
  double sum = 0.0, maps = 0.0, gbuffer = 0.0;
  renderer.render({level.scene, SceneChanges::all(), level.view, "many_lights", settings});
  const auto& kernels = renderer.backend().kernels<ManyLightsKernels>("many_lights");
  const ManyLightsCounts before = kernels.lightCounts();
  for (auto _ : state) {
    level.scene.find(level.mover)->local.translation.x += 0.001f;
    GiOutput out = renderer.render({level.scene, moved, level.view, "many_lights", settings});
    sum += out.stats.secondsOf(kLightSumsStage);
    maps += out.stats.secondsOf(kShadowMapsStage);
    gbuffer += out.stats.secondsOf(kGBufferStage);
  }
  const ManyLightsCounts after = kernels.lightCounts();
  state.counters["ns_per_light_pixel"] =
      1e9 * sum / static_cast<double>(after.lightPixels - before.lightPixels);
  state.counters["maps_per_s"] = static_cast<double>(after.shadowMaps - before.shadowMaps) / maps;
  state.counters["gbuffer_ms"] = 1e3 * gbuffer / static_cast<double>(state.iterations());
}

}  // namespace

void addNaiveBenchmarks(const std::string& backend, const MakeBackend& make) {
  for (const std::string scene : kScenes) {
    const auto name = [&](const char* what) {
      return std::string("naive/") + what + "/" + scene + "/" + backend;
    };
    auto* camera =
        benchmark::RegisterBenchmark(name("camera_moves").c_str(), cameraMoves, scene, make);
    auto* object =
        benchmark::RegisterBenchmark(name("object_moves").c_str(), objectMoves, scene, make);
    for (const int vpls : {2, 10, 30, 100, 300, 1000}) {
      camera->Arg(vpls);
      object->Arg(vpls);
    }
    camera->Unit(benchmark::kMillisecond)->UseRealTime();
    object->Unit(benchmark::kMillisecond)->UseRealTime();
    benchmark::RegisterBenchmark(name("kernels").c_str(), kernels, scene, make)
        ->Arg(300)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  }
}

}  // namespace lamplighter
