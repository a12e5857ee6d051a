// The visibility database: building it, updating it after an object or a light moved, and the time
// that it saves in the sums ("VD" against "Naïve" in figure 5-3).
#include <chrono>
#include <cmath>
#include <filesystem>

#include <benchmark/benchmark.h>
#include <glm/gtc/constants.hpp>

#include "renderer/base/data_folder.h"
#include "renderer/frame/frame.h"
#include "renderer/light_maps/pass_merging.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/light_shapes.h"
#include "renderer/visibility/visibility_database.h"
#include "tests/tools/bench/backend_benches.h"
#include "tests/tools/bench/ball.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

struct Case {
  const char* name;
  const char* path;   // assets/ or shared/
  const char* mover;  // "": a ball of one metre is added at the centre of the level
  int vpls;
};
constexpr Case kCases[] = {
    {"pillar_room", "assets/scenes/pillar_room.gltf", "mover", 300},
    {"area_light_room", "assets/scenes/area_light_room.gltf", "mover", 300},
    {"kenney", "../shared/scenes/kenney-fps-level/kenney-fps-level.gltf", "", 300},
    {"zdm2", "../shared/scenes/zdm2-map/zdm2.glb", "", 30}};

struct World {
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  std::vector<shared::Vpl> lights;
  NodeId mover = kNoNode;

  explicit World(const Case& c) {
    scene = loadGltf(dataFolder() / c.path).scene;
    if (std::string(c.mover).empty()) mover = addBall(scene);
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    for (const SceneVpl& v :
         generateVpls(render, *rays, LightSet(render), {c.vpls, 0.5f, 1, 1}).vpls)
      lights.push_back(v.vpl);
    for (const Node& n : scene.nodes)
      if (mover == kNoNode && n.name == c.mover) mover = n.id;
  }
};

void fill(VisibilityDatabase& database, const World& w) {
  RenderSceneChanges all;
  all.rebuilt = true;
  database.setScene(w.render, all);
  database.setLights(w.render, w.lights);
}

bool skip(benchmark::State& state, const Case& c) {
  if (fs::exists(dataFolder() / c.path)) return false;
  state.SkipWithError("the scene is not there");
  return true;
}

void build(benchmark::State& state, const Case& c) {
  if (skip(state, c)) return;
  const World w(c);
  VisibilityCounts counts;
  for (auto _ : state) {
    VisibilityDatabase database;
    fill(database, w);
    state.PauseTiming();
    counts = database.counts();
    state.counters["tests"] = static_cast<double>(database.tests());
    state.ResumeTiming();
  }
  const auto entries = static_cast<double>(counts.none + counts.partial + counts.full);
  state.counters["patches"] = static_cast<double>(counts.patches);
  state.counters["partial"] = static_cast<double>(counts.partial) / entries;
}

// With increasing numbers of VPLs, separately or in clusters.
void buildMany(benchmark::State& state, Case c, bool clusters) {
  if (skip(state, c)) return;
  c.vpls = static_cast<int>(state.range(0));
  const World w(c);
  for (auto _ : state) {
    VisibilityDatabase database;
    database.useClusters(clusters);
    fill(database, w);
    state.counters["tests"] = static_cast<double>(database.tests());
    state.counters["megabytes"] = 1e-6 * static_cast<double>(database.bytes());
  }
}

// Steps of 5 cm: back and forth along an axis, or around a circle, so that no two directions are
// equal.
void moveObject(benchmark::State& state, const Case& c, bool inCircles) {
  if (skip(state, c)) return;
  World w(c);
  VisibilityDatabase database;
  fill(database, w);
  constexpr float kStep = 0.05f;
  int step = 0;
  const auto move = [&] {
    Scene moved = w.scene;
    const float angle = inCircles ? glm::radians(20.0f * static_cast<float>(step))
                                  : kPi * static_cast<float>(step % 2);
    moved.find(w.mover)->local.translation +=
        kStep * vec3(std::cos(angle), 0.0f, inCircles ? std::sin(angle) : 0.0f);
    ++step;
    const RenderSceneChanges changes = update(w.render, moved, compare(w.scene, moved));
    w.scene = moved;
    return changes;
  };
  const auto take = [&](const RenderSceneChanges& changes) {
    database.setScene(w.render, changes);
    database.refreshAll(w.render);
  };
  // The first step of a drag computes data that the following steps reuse.
  const RenderSceneChanges first = move();
  const auto begin = std::chrono::steady_clock::now();
  take(first);
  const std::chrono::duration<double, std::milli> firstStep =
      std::chrono::steady_clock::now() - begin;
  state.counters["first_ms"] = firstStep.count();
  const uint64_t before = database.tests();
  for (auto _ : state) {
    state.PauseTiming();
    const RenderSceneChanges changes = move();
    state.ResumeTiming();
    take(changes);
  }
  state.counters["tests"] =
      static_cast<double>(database.tests() - before) / static_cast<double>(state.iterations());
}

void moveOneLight(benchmark::State& state, const Case& c) {
  if (skip(state, c)) return;
  World w(c);
  VisibilityDatabase database;
  fill(database, w);
  float step = 0.01f;
  for (auto _ : state) {
    w.lights[0].position.x += step;
    step = -step;
    database.setLights(w.render, w.lights);
  }
}

// A hundred lights move at once, like the samples of a light that is dragged.
void moveLights(benchmark::State& state, const Case& c) {
  if (skip(state, c)) return;
  World w(c);
  VisibilityDatabase database;
  fill(database, w);
  const size_t count = std::min<size_t>(100, w.lights.size());
  float step = 0.01f;
  for (auto _ : state) {
    for (size_t i = 0; i < count; ++i) w.lights[i].position.x += step;
    step = -step;
    database.setLights(w.render, w.lights);
  }
  state.counters["a_column"] =
      benchmark::Counter(static_cast<double>(count) * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

// The saving of the paper's merging of passes (4.3.5), in draws for the lights that need their
// shadow maps: K lights of one object per draw; the same merged; and the gl backend's way, where
// each pixel has its own list and the object with most lights determines the number of draws.
void mergePassesOf(benchmark::State& state, const Case& c, int lightsPerPass) {
  if (skip(state, c)) return;
  const World w(c);
  VisibilityDatabase database;
  fill(database, w);
  std::vector<uint32_t> objects;
  for (uint32_t i = 0; i < w.render.objects.size(); ++i) objects.push_back(i);
  const std::vector<PassElement> elements = shadowedLights(database, objects);
  MergedPasses merged;
  for (auto _ : state) merged = mergePasses(elements, lightsPerPass);
  int listed = 0;
  for (const PassElement& e : elements) listed = std::max(listed, passesOf(e, lightsPerPass));
  state.counters["by_object"] = merged.passes + merged.saved;
  state.counters["merged"] = merged.passes;
  state.counters["by_lists"] = listed;
}

// A frame in which the camera moved. `technique`: with "+block4" etc., by blocks.
void frames(benchmark::State& state, const Case& c, const std::string& technique,
            const MakeBackend& make, int width, int height, int lightsPerPass, bool merge,
            bool prt) {
  if (skip(state, c)) return;
  const World w(c);
  View view = viewOfBounds(w.render.bounds, width, height);
  for (const Node& node : w.scene.nodes)
    if (node.camera != kNone) view = viewOfCamera(w.scene, node, width, height);
  Settings settings;
  settings.set("vpls", c.vpls);
  settings.set("updates", c.vpls);
  settings.set("bounces", 1);
  settings.set("indirect", std::string("samples"));  // as in the paper
  settings.set("antialias", 1);
  const size_t plus = technique.find("+block");
  settings.set("technique", technique.substr(0, plus));
  settings.set("block", plus == std::string::npos ? std::string("1") : technique.substr(plus + 6));
  settings.set("lights_per_pass", lightsPerPass);
  settings.set("merge_passes", merge);
  settings.set("prt", prt);
  FrameRenderer renderer(make());
  GiStats stats;
  const auto frame = [&](const SceneChanges& changes) {
    stats = renderer.render({w.scene, changes, view, "many_lights", settings}).stats;
    renderer.backend().finish();
  };
  frame(SceneChanges::all());
  frame({});  // shaders are built on first use
  for (auto _ : state) {
    view.eye.x += 0.001f;
    frame({});
  }
  if (stats.of("interpolated_share") > 0.0f)
    state.counters["interpolated"] = stats.of("interpolated_share");
  if (!merge) return;
  state.counters["passes"] = stats.of("merged_passes");
  state.counters["saved"] = stats.of("passes_saved");
}

template <typename F, typename... More>
void add(const std::string& name, F function, More... more) {
  benchmark::RegisterBenchmark(name.c_str(), function, more...)
      ->Unit(benchmark::kMillisecond)
      ->UseRealTime()
      ->MeasureProcessCPUTime();
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Case& c : kCases) {
    const std::string name = c.name;
    add("visibility/build/" + name, build, c);
    for (const bool clusters : {false, true}) {
      benchmark::RegisterBenchmark(
          ("visibility/clusters/" + name + (clusters ? "/on" : "/off")).c_str(), buildMany, c,
          clusters)
          ->Unit(benchmark::kMillisecond)
          ->MeasureProcessCPUTime()
          ->Iterations(1)
          ->Arg(300)
          ->Arg(1000)
          ->Arg(4096);
    }
    add("visibility/object_moves/" + name, moveObject, c, false);
    add("visibility/object_circles/" + name, moveObject, c, true);
    add("visibility/one_light_moves/" + name, moveOneLight, c);
    add("visibility/lights_move/" + name, moveLights, c);
    for (const int most : {6, 64, 1024})
      add("visibility/merge_passes/" + name + "/" + std::to_string(most), mergePassesOf, c, most);
  }
  return true;
}();

}  // namespace

void addTechniqueBenchmarks(const std::string& backend, const MakeBackend& make) {
  constexpr glm::ivec2 kSizes[] = {{640, 360}, {1024, 768}};
  for (const Case& c : kCases) {
    for (const glm::ivec2& size : kSizes) {
      // The room of figure 5-1, at the paper's size.
      if (size.x == 1024 && std::string(c.name) != "area_light_room") continue;
      const std::string name = "visibility/frame/" + backend + "/" + c.name + "/" +
                               std::to_string(size.x) + "x" + std::to_string(size.y) + "/";
      for (const std::string technique :
           {"naive", "visibility", "light_maps", "visibility+block4", "light_maps+block2",
            "light_maps+block4", "light_maps+block8"})
        add(name + technique, frames, c, technique, make, size.x, size.y, 1024, false, false);
      add(name + "everything", frames, c, std::string("light_maps+block4"), make, size.x, size.y,
          1024, false, true);
    }
    // Separate lists for each patch, compared with the paper's merged passes of 6 lights.
    if (backend == "gl" && std::string(c.name) != "zdm2") {
      for (const bool merge : {false, true}) {
        add("visibility/merge_passes/" + backend + "/" + c.name + "/6/" + (merge ? "on" : "off"),
            frames, c, std::string("light_maps"), make, 640, 360, 6, merge, false);
      }
    }
    // The paper's K lights per pass.
    if (backend != "gl" || std::string(c.name) != "area_light_room") continue;
    for (const int most : {1, 6, 64}) {
      add("visibility/lights_a_pass/" + backend + "/" + c.name + "/" + std::to_string(most), frames,
          c, std::string("visibility"), make, 640, 360, most, false, false);
    }
  }
}

}  // namespace lamplighter
