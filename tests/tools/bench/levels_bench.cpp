// Edits in real levels, seen from inside, at defaults with the budgets of the editor's window, on
// the cpu backend (levels/) and on the gl backend (levels_gl/):
// opening, changes of brightness, a lamp that is added, moved and deleted, an object that is
// hidden, objects that are duplicated, and a flight. The levels are those of ../shared/scenes;
// without that folder there are none.
#include <algorithm>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/base/data_folder.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/units.h"
#include "tests/tools/bench/window_frames.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 1280, kHeight = 720;

struct Level {
  const char* file;
  // Used if the file has no camera.
  vec3 eye{0.0f};
  quat turn{1.0f, 0.0f, 0.0f, 0.0f};
};
const Level kLevels[] = {
    {"modern-hall/modern-hall.glb"},
    {"living-room/living-room.gltf"},
    {"classroom/classroom.gltf"},
    {"bathroom/bathroom.glb"},
    {"bedroom/bedroom.glb"},
    {"kenney-fps-level/kenney-fps-level.gltf"},
    {"zdm2-map/zdm2.glb", {5, 6, 8}, {0.8901f, 0, 0.4557f, 0}},
    {"candela-city/candela_city.glb", {-90, -2, 35}, {0.809f, 0, -0.5878f, 0}}};

fs::path fileOf(const Level& level) {
  return dataFolder() / "../shared/scenes" / fs::path(level.file);
}

struct Opened {
  Scene scene;
  View view;

  Opened(const Level& level, int width, int height) : scene(loadGltf(fileOf(level)).scene) {
    bool hasCamera = false;
    for (const Node& n : scene.nodes) {
      if (n.camera == kNone || hasCamera) continue;
      view = viewOfCamera(scene, n, width, height);
      hasCamera = true;
    }
    if (hasCamera) return;
    view.eye = level.eye;
    view.orientation = level.turn;
    view.width = width;
    view.height = height;
    view.yfov = 1.05f;
    view.znear = 0.05f;
  }

  // A rectangle light in front of the camera that aims down.
  NodeId addLamp() {
    Node lamp;
    lamp.id = 1;
    for (const Node& n : scene.nodes) lamp.id = std::max(lamp.id, n.id + 1);
    lamp.name = "lamp";
    lamp.area = AreaLight{.radiance = vec3(20.0f), .size = vec2(1.0f, 0.5f)};
    lamp.local.translation = view.eye + 2.5f * view.forward() + vec3(0.0f, 0.5f, 0.0f);
    lamp.local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1.0f, 0.0f, 0.0f));
    scene.nodes.push_back(lamp);
    return lamp.id;
  }
};

// The node of the mesh that covers most of the picture, by a grid of eye rays.
NodeId largestInView(const Opened& opened) {
  constexpr int kPixelsARay = 16;
  RenderScene render;
  update(render, opened.scene, SceneChanges::all());
  const RayCaster rays(render);
  const View view = inUnits(opened.view, render.unit);
  std::map<NodeId, int> counts;
  for (int y = kPixelsARay / 2; y < view.height; y += kPixelsARay) {
    for (int x = kPixelsARay / 2; x < view.width; x += kPixelsARay) {
      const vec3 way = view.rayDirection(static_cast<float>(x), static_cast<float>(y));
      if (const Hit hit = rays.intersect({view.eye, 0.0f, way}, Surfaces::seen))
        ++counts[render.objects[hit.object].node];
    }
  }
  const auto most = std::ranges::max_element(counts, {}, [](const auto& c) { return c.second; });
  return most == counts.end() ? kNoNode : most->first;
}

// As the editor does: a copy of the node at the same position, with the next free id.
void duplicate(Scene& scene, NodeId id) {
  const auto node = std::ranges::find(scene.nodes, id, &Node::id);
  if (node == scene.nodes.end()) return;
  Node copy = *node;
  for (const Node& n : scene.nodes) copy.id = std::max(copy.id, n.id + 1);
  copy.name += " copy";
  scene.nodes.push_back(std::move(copy));
}

using MakeBackend = std::function<std::unique_ptr<Backend>()>;

// An edit, done and undone in turns.
using Edit = std::function<void(Scene&, bool isDone)>;

void brighten(Scene& scene, bool isDone) {
  const float factor = isDone ? 1.0f / 1.2f : 1.2f;
  for (Node& n : scene.nodes) {
    if (n.area) n.area->radiance *= factor;
    if (n.punctual) n.punctual->intensity *= factor;
  }
  for (Material& m : scene.materials) m.emissive *= factor;
  if (scene.sky.kind == SkyKind::constant) scene.sky.radiance *= factor;
  if (scene.sky.kind == SkyKind::image) scene.sky.scale *= factor;
}

// Stages of the first frame after an edit that take 5 ms or more, means over the edits.
class FirstFrames {
 public:
  void take(const GiStats& stats) {
    ++frames_;
    for (const auto& [stage, seconds] : stats.stageSeconds) seconds_[stage.name] += seconds;
  }
  std::string text() const {
    constexpr double kLeast = 5e-3;  // seconds
    std::vector<std::pair<double, std::string_view>> stages;
    for (const auto& [name, seconds] : seconds_)
      if (seconds >= kLeast * frames_) stages.emplace_back(seconds / frames_, name);
    std::ranges::sort(stages, std::greater());
    std::string text = "first:";
    for (const auto& [seconds, name] : stages)
      text += fmt::format(" {} {:.0f} ms,", name, 1e3 * seconds);
    return text;
  }

 private:
  int frames_ = 0;
  std::map<std::string_view, double> seconds_;  // by stage
};

// The longest of some frames, and its longest stage.
class Longest {
 public:
  void take(const WindowFrames& window, const GiOutput& out) {
    if (window.lastFrame() <= seconds_) return;
    seconds_ = window.lastFrame();
    const auto stage = std::ranges::max_element(out.stats.stageSeconds, {}, &StageTime::seconds);
    if (stage == out.stats.stageSeconds.end()) return;
    stage_ = fmt::format("{} {:.0f} ms", stage->stage.name, 1e3 * stage->seconds);
  }
  void report(benchmark::State& state, const std::string& more = "") const {
    state.counters["ms_longest"] = 1e3 * seconds_;
    state.SetLabel(more + " longest: " + stage_);
  }

 private:
  double seconds_ = 0.0;
  std::string stage_;
};

struct Run {
  const Level& level;
  MakeBackend makeBackend;
};

void measure(benchmark::State& state, const Run& run, bool startsWithLamp, const Edit& edit) {
  Opened opened(run.level, kWidth, kHeight);
  if (startsWithLamp) opened.addLamp();
  Scene& scene = opened.scene;
  WindowFrames window(run.makeBackend());
  window.settle(scene, SceneChanges::all(), opened.view);
  double first = 0.0, rays = 0.0, settledAtOnce = 0.0;
  Longest longest;
  FirstFrames firstFrames;
  bool isDone = false;
  int edits = 0;
  for (auto _ : state) {
    const Scene before = scene;
    edit(scene, isDone);
    isDone = !isDone;
    const uint64_t raysBefore = window.backend().counts().rays;
    GiOutput out = window.frame(scene, compare(before, scene), opened.view, "edit");
    first += window.lastFrame();
    firstFrames.take(out.stats);
    rays += static_cast<double>(window.backend().counts().rays - raysBefore) +
            static_cast<double>(out.stats.raysTraced);
    settledAtOnce += out.settled ? 1.0 : 0.0;
    longest.take(window, out);
    while (!out.settled) {
      out = window.frame(scene, {}, opened.view);
      longest.take(window, out);
    }
    ++edits;
  }
  double within95 = 0.0, settled = 0.0;
  const auto count = static_cast<double>(std::max<size_t>(window.latency().results().size(), 1));
  for (const LatencyResult& r : window.latency().results()) {
    within95 += r.within[1].milliseconds / count;
    settled += r.settled.milliseconds / count;
  }
  state.counters["ms_first"] = 1e3 * first / edits;
  longest.report(state, firstFrames.text());
  state.counters["ms_95"] = within95;
  state.counters["ms_settled"] = settled;
  state.counters["rays_first"] = rays / edits;
  state.counters["settled_at_once"] = settledAtOnce / edits;
}

void open(benchmark::State& state, const Run& run) {
  double first = 0.0;
  for (auto _ : state) {
    const double begin = benchSeconds();
    const Opened opened(run.level, kWidth, kHeight);
    WindowFrames window(run.makeBackend());
    const GiOutput out = window.frame(opened.scene, SceneChanges::all(), opened.view);
    first += benchSeconds() - begin;
    if (!out.settled) window.settle(opened.scene, {}, opened.view);
  }
  state.counters["s_first"] = first / static_cast<double>(state.iterations());
}

// Forward, with a turn; the mean frame after the first.
void fly(benchmark::State& state, const Run& run) {
  Opened opened(run.level, 640, 360);
  WindowFrames window(run.makeBackend());
  window.settle(opened.scene, SceneChanges::all(), opened.view);
  Longest longest;
  for (auto _ : state) {
    opened.view.eye += 0.03f * opened.view.forward();
    opened.view.orientation =
        glm::angleAxis(0.01f, vec3(0.0f, 1.0f, 0.0f)) * opened.view.orientation;
    longest.take(window, window.frame(opened.scene, {}, opened.view));
  }
  state.counters["fps"] =
      benchmark::Counter(static_cast<double>(state.iterations()), benchmark::Counter::kIsRate);
  longest.report(state);
}

void add(const std::string& group, const Run& run) {
  const std::string name = group + "/" + fs::path(run.level.file).begin()->string() + "/";
  const auto registered = [&](const char* what, auto body) {
    return benchmark::RegisterBenchmark((name + what).c_str(), body)
        ->Unit(benchmark::kMillisecond)
        ->UseRealTime();
  };
  registered("open", [run](benchmark::State& s) { open(s, run); })->Iterations(1);
  registered("brightness", [run](benchmark::State& s) {
    measure(s, run, false, brighten);
  })->Iterations(8);
  registered("lamp_moved", [run](benchmark::State& s) {
    measure(s, run, true, [](Scene& scene, bool isDone) {
      scene.nodes.back().local.translation.x += isDone ? -0.5f : 0.5f;
    });
  })->Iterations(2);
  registered("lamp_added_and_deleted", [run](benchmark::State& s) {
    Node lamp;
    measure(s, run, true, [&](Scene& scene, bool isDone) {
      if (isDone) {
        scene.nodes.push_back(lamp);
      } else {
        lamp = scene.nodes.back();
        scene.nodes.pop_back();
      }
    });
  })->Iterations(2);
  registered("object_hidden", [run](benchmark::State& s) {
    measure(s, run, true, [](Scene& scene, bool isDone) {
      const auto mesh = std::find_if(scene.nodes.rbegin(), scene.nodes.rend(),
                                     [](const Node& n) { return n.mesh != kNone; });
      if (mesh != scene.nodes.rend()) mesh->visible = isDone;
    });
  })->Iterations(2);
  registered("lamp_duplicated", [run](benchmark::State& s) {
    measure(s, run, true, [](Scene& scene, bool isDone) {
      if (isDone) {
        scene.nodes.pop_back();
      } else {
        duplicate(scene, scene.nodes.back().id);
      }
    });
  })->Iterations(2);
  registered("object_duplicated", [run](benchmark::State& s) {
    const NodeId largest = largestInView(Opened(run.level, kWidth, kHeight));
    measure(s, run, false, [largest](Scene& scene, bool isDone) {
      if (isDone) {
        scene.nodes.pop_back();
      } else {
        duplicate(scene, largest);
      }
    });
  })->Iterations(2);
  registered("flight", [run](benchmark::State& s) { fly(s, run); })->Iterations(60);
}

[[maybe_unused]] const bool kRegistered = [] {
  for (const Level& level : kLevels) {
    if (fs::exists(fileOf(level))) {
      add("levels", {level, makeCpuBackend});
      add("levels_gl", {level, [] { return makeGlBackend(); }});
    }
  }
  return true;
}();

}  // namespace
}  // namespace lamplighter
