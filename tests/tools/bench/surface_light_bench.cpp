// Light on surfaces: gathers, masks against rays to the same places, bounces.
#include <array>
#include <filesystem>

#include <benchmark/benchmark.h>

#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {
namespace {

struct Level {
  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  explicit Level(const std::filesystem::path& file) {
    update(scene, loadGltf(file).scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(scene);
  }
};

std::filesystem::path roomFile() { return "assets/scenes/pillar_room.gltf"; }

RenderSceneChanges everything() {
  RenderSceneChanges changes;
  changes.rebuilt = true;
  return changes;
}

// From nothing: elements, 256 rays for each sample, direct light, 5 bounces.
void BM_SurfaceLight(benchmark::State& state) {
  const Level level(roomFile());
  double samples = 0.0;
  for (auto _ : state) {
    SurfaceLight light;
    light.update(level.scene, everything(), *level.rays, {5});
    samples += static_cast<double>(light.counts().samples);
  }
  state.counters["samples/s"] = benchmark::Counter(samples, benchmark::Counter::kIsRate);
}
BENCHMARK(BM_SurfaceLight)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

// Only the bounces, as after an edit of brightness.
void BM_SurfaceLightBounces(benchmark::State& state) {
  const Level level(roomFile());
  SurfaceLight light;
  light.update(level.scene, everything(), *level.rays, {5});
  RenderSceneChanges gains;
  gains.gains = true;
  for (auto _ : state) light.update(level.scene, gains, *level.rays, {5});
}
BENCHMARK(BM_SurfaceLightBounces)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

FlatLight lightOver(const vec3& origin) {
  FlatLight light;
  light.origin = origin;
  light.across = vec3(1.0f, 0.0f, 0.0f);
  light.up = vec3(0.0f, 0.0f, 1.0f);
  light.normal = vec3(0.0f, -1.0f, 0.0f);
  light.shape.fill(~uint64_t{0});
  return light;
}

// Eight large triangles between a point and a light.
void BM_MaskOf8Blockers(benchmark::State& state) {
  const FlatLight light = lightOver(vec3(-0.5f, 3.0f, -0.5f));
  std::array<std::array<vec3, 3>, 8> blockers;
  for (size_t i = 0; i < blockers.size(); ++i) {
    const float at = 0.12f * static_cast<float>(i) - 0.5f;
    blockers[i] = {vec3(at, 1.5f, -0.4f), vec3(at + 0.2f, 1.6f, 0.3f),
                   vec3(at + 0.05f, 1.4f, 0.4f)};
  }
  for (auto _ : state) {
    VisiblePlaces places(light, vec3(0.0f));
    for (const auto& t : blockers) places.block(t[0], t[1], t[2]);
    benchmark::DoNotOptimize(places.visibleShare(vec3(0.0f, 1.0f, 0.0f)));
  }
}
BENCHMARK(BM_MaskOf8Blockers)->Unit(benchmark::kMicrosecond);

void BM_RaysToTheSamePlaces(benchmark::State& state) {
  const Level level(roomFile());
  const FlatLight light = lightOver(vec3(-0.5f, 3.3f, -0.5f));
  const vec3 from(0.4f, 0.1f, 0.6f);
  for (auto _ : state) {
    int visible = 0;
    for (int row = 0; row < 64; ++row) {
      for (int column = 0; column < 64; ++column) {
        const vec3 to =
            light.place(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f);
        visible += !level.rays->occluded({from, 0.0f, to - from, 1.0f});
      }
    }
    benchmark::DoNotOptimize(visible);
  }
}
BENCHMARK(BM_RaysToTheSamePlaces)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace lamplighter
