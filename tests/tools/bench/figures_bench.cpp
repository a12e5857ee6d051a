// The measurements of figures 5-3 to 5-6 of paper 1, repeated with this renderer: frame time over
// the number of VPLs and over updates per frame, the time of shadow maps over the vertices of the
// moving object, and the time of each stage.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/methods/many_lights/stages.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/tools/bench/backend_benches.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Renders a scene repeatedly while its mover moves back and forth.
class Moving {
 public:
  Moving(const std::string& path, const MakeBackend& make, int vpls, int updates)
      : scene_(loadGltf(dataFolder() / path).scene), renderer_(make(), seconds) {
    for (const Node& node : scene_.nodes) {
      if (node.camera != kNone && !hasView_) {
        view_ = viewOfCamera(scene_, node, 640, 360);
        hasView_ = true;
      }
      if (node.name == "mover") mover_ = node.id;
    }
    if (!hasView_) {
      RenderScene level;
      update(level, scene_, SceneChanges::all());
      view_ = viewOfBounds(level.bounds, 640, 360);
    }
    settings_.set("vpls", vpls);
    settings_.set("updates", updates);
    settings_.set("bounces", 1);
    settings_.set("indirect", std::string("samples"));  // as in the paper
    settings_.set("antialias", 1);
  }

  Scene& scene() { return scene_; }
  Node& mover() { return *scene_.find(mover_); }

  void settle() {
    GiOutput out = frame(SceneChanges::all());
    while (!out.settled) out = frame({});
  }
  GiStats moveCamera() {
    view_.eye.x += 0.001f;
    return frame({}).stats;
  }
  GiStats moveObject() {
    SceneChanges moved;
    moved.moved = {mover_};
    mover().local.translation.x += steps_++ % 2 == 0 ? 0.05f : -0.05f;
    return frame(moved).stats;
  }

 private:
  GiOutput frame(const SceneChanges& changes) {
    GiOutput out = renderer_.render({scene_, changes, view_, "many_lights", settings_});
    renderer_.backend().finish();
    return out;
  }

  Scene scene_;
  FrameRenderer renderer_;
  Settings settings_;
  View view_;
  bool hasView_ = false;
  NodeId mover_ = kNoNode;
  int steps_ = 0;
};

// Figure 5-3 with the default settings: the camera moves.
void againstVpls(benchmark::State& state, const std::string& path, const MakeBackend& make) {
  if (!fs::exists(dataFolder() / path)) {
    state.SkipWithError("the scene is not there");
    return;
  }
  const int vpls = static_cast<int>(state.range(0));
  Moving level(path, make, vpls, vpls);
  level.settle();
  double sums = 0.0, all = 0.0;
  double maps = 0.0;
  for (auto _ : state) {
    const GiStats stats = level.moveCamera();
    for (const auto& [stage, time] : stats.stageSeconds) all += time;
    sums += stats.secondsOf(kLightSumsStage);
    maps = stats.of("maps_held");
  }
  state.counters["sums_percent"] = 100.0 * sums / all;
  state.counters["maps"] = maps;
}

// Figure 5-4: an object moves.
void againstUpdates(benchmark::State& state, const MakeBackend& make) {
  Moving level("assets/scenes/pillar_room.gltf", make, 300, static_cast<int>(state.range(0)));
  level.settle();
  int refreshed = 0;
  for (auto _ : state) refreshed += level.moveObject().updates;
  state.counters["vpls_a_frame"] =
      static_cast<double>(refreshed) / static_cast<double>(state.iterations());
}

// A ball of approximately `vertices` vertices.
std::shared_ptr<Mesh> ball(int vertices) {
  auto mesh = std::make_shared<Mesh>();
  Primitive& p = mesh->primitives.emplace_back();
  const int rings = std::max(3, static_cast<int>(std::sqrt(vertices / 2.0)));
  const int columns = 2 * rings;
  for (int r = 0; r <= rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const float theta = kPi * static_cast<float>(r) / static_cast<float>(rings);
      const float phi = 2.0f * kPi * static_cast<float>(c) / static_cast<float>(columns);
      const vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta),
                   std::sin(theta) * std::sin(phi));
      p.positions.push_back(0.5f * n);
      p.normals.push_back(n);
    }
  }
  for (int r = 0; r < rings; ++r) {
    for (int c = 0; c < columns; ++c) {
      const int next = (c + 1) % columns;
      const auto a = static_cast<uint32_t>(r * columns + c),
                 b = static_cast<uint32_t>(r * columns + next),
                 d = a + static_cast<uint32_t>(columns), e = b + static_cast<uint32_t>(columns);
      p.indices.insert(p.indices.end(), {a, b, d, b, e, d});
    }
  }
  return mesh;
}

// Figure 5-5: all 300 shadow maps are rendered while a ball with an increasing number of vertices
// moves.
void againstVertices(benchmark::State& state, const MakeBackend& make) {
  Moving level("assets/scenes/pillar_room.gltf", make, 300, 300);
  const auto mesh = ball(static_cast<int>(state.range(0)));
  level.mover().mesh = static_cast<int>(level.scene().meshes.size());
  level.scene().meshes.push_back(mesh);
  level.settle();
  double maps = 0.0, visibility = 0.0;
  for (auto _ : state) {
    const GiStats stats = level.moveObject();
    maps += stats.secondsOf(kShadowMapsStage);
    visibility += stats.secondsOf(kVisibilityStage);
  }
  const auto frames = static_cast<double>(state.iterations());
  state.counters["vertices"] = static_cast<double>(mesh->primitives[0].positions.size());
  state.counters["shadow_maps_ms"] = 1e3 * maps / frames;
  state.counters["visibility_ms"] = 1e3 * visibility / frames;
}

// Figure 5-6: an object moves, and 100 VPLs are updated per frame.
void stages(benchmark::State& state, const std::string& path, const MakeBackend& make) {
  Moving level(path, make, 300, 100);
  level.settle();
  std::map<std::string, double> shares;
  double all = 0.0;
  for (auto _ : state) {
    for (const auto& [stage, time] : level.moveObject().stageSeconds) {
      shares[std::string(stage.name)] += time;
      all += time;
    }
  }
  for (const auto& [stage, time] : shares) {
    std::string name = stage + "_percent";
    std::replace(name.begin(), name.end(), ' ', '_');
    state.counters[name] = 100.0 * time / all;
  }
}

}  // namespace

void addFigureBenchmarks(const std::string& backend, const MakeBackend& make) {
  const auto add = [&](const std::string& name, auto function, auto... more) {
    return benchmark::RegisterBenchmark(name.c_str(), function, more...)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime()
        ->MeasureProcessCPUTime()
        ->Iterations(8);
  };
  const std::pair<const char*, const char*> levels[] = {
      {"area_light_room", "assets/scenes/area_light_room.gltf"},
      {"table_room", "assets/scenes/table_room.gltf"},
      {"pillar_room", "assets/scenes/pillar_room.gltf"},
      {"modern_hall", "../shared/scenes/modern-hall/modern-hall.glb"}};
  for (const auto& [name, path] : levels) {
    auto* sweep = add("figure_5_3/vpls/" + std::string(name) + "/" + backend, againstVpls,
                      std::string(path), make);
    for (const int vpls : {2, 10, 30, 100, 300, 1000, 4096}) sweep->Arg(vpls);
    if (std::string(name) == "modern_hall") continue;
    add("figure_5_6/stages/" + std::string(name) + "/" + backend, stages, std::string(path), make);
  }
  auto* updates = add("figure_5_4/updates/" + backend, againstUpdates, make);
  for (const int count : {1, 10, 30, 100, 300}) updates->Arg(count);
  auto* vertices = add("figure_5_5/vertices/" + backend, againstVertices, make);
  for (const int count : {100, 1000, 10000, 100000}) vertices->Arg(count);
}

}  // namespace lamplighter
