// Points of occluders in a level: groups, importance, and drawing. Counters are
// the time for one triangle or point, on all threads together.
#include <cmath>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "renderer/base/low_discrepancy.h"
#include "renderer/base/random.h"
#include "renderer/imperfect_maps/occluder_points.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/gltf/gltf_io.h"

namespace lamplighter {
namespace {

// 378,000 triangles where the scenes beside the repository are missing.
Scene generatedLevel() {
  Scene scene;
  Primitive p;
  constexpr uint32_t kSide = 435;
  for (uint32_t y = 0; y <= kSide; ++y) {
    for (uint32_t x = 0; x <= kSide; ++x) {
      const float u = 0.05f * static_cast<float>(x), v = 0.05f * static_cast<float>(y);
      p.positions.emplace_back(u, 0.3f * std::sin(2.0f * u) * std::cos(3.0f * v), v);
      p.normals.emplace_back(0.0f, 1.0f, 0.0f);
    }
  }
  for (uint32_t y = 0; y < kSide; ++y) {
    for (uint32_t x = 0; x < kSide; ++x) {
      const uint32_t a = y * (kSide + 1) + x, b = a + kSide + 1;
      p.indices.insert(p.indices.end(), {a, b, a + 1, a + 1, b, b + 1});
    }
  }
  auto mesh = std::make_shared<Mesh>();
  mesh->primitives.push_back(std::move(p));
  scene.meshes.push_back(std::move(mesh));
  Node& node = scene.nodes.emplace_back();
  node.id = scene.nextId++;
  node.mesh = 0;
  return scene;
}

// What is seen from two places.
struct OccluderLevel {
  RenderScene scene;
  std::vector<vec3> view, lights;

  OccluderLevel() {
    const std::filesystem::path file = "../shared/scenes/bathroom/bathroom.glb";
    update(scene, std::filesystem::exists(file) ? loadGltf(file).scene : generatedLevel(),
           SceneChanges::all());
    const RayCaster rays(scene);
    const vec3 centre = scene.bounds.centre(), extent = scene.bounds.extent();
    const auto look = [&](const vec3& from, uint32_t seed) {
      std::vector<vec3> seen;
      for (uint32_t i = 0; i < 128; ++i) {
        const vec3 d = sampleSphere(sobol2(i, seed));
        const Hit hit = rays.intersect({from, 0.0f, d});
        if (hit) seen.push_back(from + hit.t * d);
      }
      return seen;
    };
    view = look(centre, 1);
    lights = look(centre + 0.2f * extent, 2);
  }
};

const OccluderLevel& occluderLevel() {
  static const OccluderLevel level;
  return level;
}

void setTime(benchmark::State& state, const char* name, size_t items) {
  state.counters[name] =
      benchmark::Counter(static_cast<double>(items), benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

// From nothing, with the order of the triangles; 1: with known orders, as after other materials.
void BM_OccluderGroups(benchmark::State& state) {
  const RenderScene& scene = occluderLevel().scene;
  RenderSceneChanges all;
  all.rebuilt = true;
  OccluderGroups known(scene);
  for (auto _ : state) {
    if (state.range(0) == 0) {
      benchmark::DoNotOptimize(OccluderGroups(scene).groups().data());
    } else {
      known.update(scene, all);
    }
  }
  setTime(state, "triangle", known.triangles().size());
  state.counters["triangles"] = static_cast<double>(known.triangles().size());
  state.counters["groups"] = static_cast<double>(known.groups().size());
  state.counters["MB"] = 1e-6 * static_cast<double>(known.memoryBytes());
}
BENCHMARK(BM_OccluderGroups)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->UseRealTime();

// 0: positions of the view; 1: half of them of lights.
void BM_OccluderImportance(benchmark::State& state) {
  const OccluderLevel& level = occluderLevel();
  const OccluderGroups groups(level.scene);
  OccluderImportance importance;
  for (auto _ : state)
    importance.update(level.scene, groups, level.view,
                      state.range(0) == 0 ? std::span<const vec3>() : level.lights, {});
  setTime(state, "triangle", groups.triangles().size());
}
BENCHMARK(BM_OccluderImportance)->DenseRange(0, 1)->Unit(benchmark::kMillisecond)->UseRealTime();

// Draws all points again: other seeds give fresh starts with the importance, which is part of it.
void BM_FreshOccluderPoints(benchmark::State& state) {
  const OccluderLevel& level = occluderLevel();
  OccluderPoints points;
  OccluderPointOptions options;
  for (auto _ : state) {
    ++options.importance.seed;
    points.update(level.scene, {}, level.view, {}, options);
  }
  setTime(state, "point", points.size());
}
BENCHMARK(BM_FreshOccluderPoints)->Unit(benchmark::kMillisecond)->UseRealTime();

// A frame while the view moves: importance, and an eighth of the points.
void BM_OccluderPointsOfAMovingView(benchmark::State& state) {
  const OccluderLevel& level = occluderLevel();
  std::vector<vec3> view = level.view;
  OccluderPoints points;
  points.update(level.scene, {}, view, {}, {});
  for (auto _ : state) {
    for (vec3& p : view) p.x += 1e-4f;
    points.update(level.scene, {}, view, {}, {});
  }
  setTime(state, "point", points.size() / 8);
}
BENCHMARK(BM_OccluderPointsOfAMovingView)->Unit(benchmark::kMillisecond)->UseRealTime();

// A quiet frame in which an eighth of the points is drawn.
void BM_LaterOccluderPoints(benchmark::State& state) {
  const OccluderLevel& level = occluderLevel();
  std::vector<vec3> view = level.view;
  OccluderPoints points;
  points.update(level.scene, {}, view, {}, {});
  for (auto _ : state) {
    if (points.isSettled()) {
      state.PauseTiming();
      view[0].x += 1e-3f;
      points.update(level.scene, {}, view, {}, {});
      state.ResumeTiming();
    }
    points.update(level.scene, {}, view, {}, {});
  }
  setTime(state, "point", points.size() / 8);
}
BENCHMARK(BM_LaterOccluderPoints)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace lamplighter
