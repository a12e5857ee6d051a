// How often imperfect shadow maps are wrong, and what their parts cost: docs/results/
// imperfect_shadow_maps.md.
//   lamplighter_imperfect_shadow_maps [PART_OF_A_SCENE'S_PATH...] [--views N]
//   lamplighter_imperfect_shadow_maps --moving METHOD SCENE... [--camera NAME] [--set
//   NAME=VALUE]...
//     [--picture FILE]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>

#include <spdlog/fmt/fmt.h>
#include <tbb/global_control.h>

#include "renderer/backends/cpu/shadow_maps/shadow_maps.h"
#include "renderer/base/random.h"
#include "renderer/imperfect_maps/bidirectional_importance.h"
#include "renderer/imperfect_maps/imperfect_map.h"
#include "renderer/imperfect_maps/interleaved_light.h"
#include "renderer/imperfect_maps/light_choice.h"
#include "renderer/imperfect_maps/occluder_points.h"
#include "renderer/sampling/surface_sampler.h"
#include "renderer/sampling/view_points.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/surface.h"
#include "shaders/shared/vpl_shading.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"
#include "tests/tools/imperfect_shadow_maps/moving.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kLights = 128, kPoints = 128;
constexpr float kClamp = 0.5f, kBias = 0.002f;

// Of this thread's processor time where other programs run, too.
double processorSecondsOf(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double secondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Views from places 1.7 m above surfaces that face up, with free space above, towards where the
// level is deepest.
std::vector<View> insideViews(const RenderScene& scene, const RayCaster& rays, int count) {
  const SurfaceSampler surfaces(scene);
  std::vector<View> views;
  for (uint32_t i = 0; i < 100000 && static_cast<int>(views.size()) < count; ++i) {
    const SampledPoint p = surfaces.at(i, 7);
    const uint32_t* corners = &scene.indices[scene.objects[p.object].firstIndex + 3 * p.triangle];
    const vec3 a = scene.positions[corners[0]], b = scene.positions[corners[1]],
               c = scene.positions[corners[2]];
    const vec3 n = glm::cross(b - a, c - a);
    if (!(n.y > 0.9f * glm::length(n))) continue;
    const vec3 eye = a + p.u * (b - a) + p.v * (c - a) + vec3(0.0f, 1.7f, 0.0f);
    if (rays.occluded({eye - vec3(0.0f, 1.6f, 0.0f), 0.0f, vec3(0, 1, 0), 2.0f})) continue;
    if (!rays.intersect({eye, 0.0f, vec3(0, 1, 0)})) continue;
    float deepest = 0.0f, at = 0.0f;
    for (int k = 0; k < 16; ++k) {
      const float angle = 2.0f * kPi * static_cast<float>(k) / 16.0f;
      const Hit hit = rays.intersect({eye, 0.0f, {std::sin(angle), -0.1f, std::cos(angle)}});
      if (!hit || hit.t <= deepest) continue;
      deepest = hit.t;
      at = angle;
    }
    if (deepest < 2.0f) continue;
    View view;
    view.eye = eye;
    view.orientation = glm::angleAxis(at + kPi, vec3(0, 1, 0));
    view.width = 640;
    view.height = 360;
    views.push_back(view);
  }
  return views;
}

struct Level {
  explicit Level(const fs::path& file) {
    scene = loadGltf(file).scene;
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    for (const Node& node : scene.nodes)
      if (node.camera >= 0) views.push_back(viewOfCamera(scene, node, 640, 360));
  }
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  std::vector<View> views;
};

// Lights at random places of the surface, as flux leaves them where the file has no lights.
std::vector<shared::Vpl> lightsOf(const Level& level, const View& view) {
  ReflectiveMap map;
  RenderSceneChanges all;
  all.rebuilt = true;
  map.update(level.render, *level.rays, all, {}, {});
  std::vector<shared::Vpl> out;
  if (map.size() > 0) {
    const ViewSamples samples = raySamples(level.render, *level.rays, view, kPoints);
    const std::vector<float> importance = bidirectionalImportance(map, samples, kClamp);
    for (const SceneVpl& v : chooseLights(map, importance, {.count = kLights}).lights)
      out.push_back(v.vpl);
    return out;
  }
  // Where surfaces see some view sample: no light in the file.
  const SurfaceSampler surfaces(level.render);
  const std::vector<SeenPoint> points = seenPoints(level.render, *level.rays, view, kPoints);
  for (uint32_t i = 0; out.size() < kLights && i < 100000; ++i) {
    const SampledPoint p = surfaces.at(i, 3);
    const Surface s = surfaceAt(level.render, p.object, p.triangle, p.u, p.v);
    const vec3 at = s.position + rayEpsilon(s.position) * s.geometricNormal;
    const bool isUseful = std::ranges::any_of(points, [&](const SeenPoint& q) {
      const vec3 way = q.position - at;
      return glm::dot(way, s.geometricNormal) > 0.0f && glm::dot(way, q.normal) < 0.0f &&
             glm::dot(way, way) < 400.0f;
    });
    if (!isUseful) continue;
    shared::Vpl vpl{};
    vpl.position = vec4(at, shared::kVplCosine);
    vpl.normal = vec4(s.geometricNormal, 0.0f);
    vpl.tangent = vec4(Frame(s.geometricNormal).tangent, 1.0f);
    vpl.intensity = vec3(1.0f);
    out.push_back(vpl);
  }
  return out;
}

struct Wrong {
  double pairs = 0.0, lit = 0.0, dark = 0.0;  // wrongly lit; wrongly dark
  double percent() const { return pairs > 0.0 ? 100.0 * (lit + dark) / pairs : 0.0; }
};

using MapOf = std::function<std::span<const float>(const shared::Vpl&, size_t)>;

Wrong wrongPairs(const Level& level, std::span<const shared::Vpl> lights,
                 std::span<const SeenPoint> points, const MapOf& mapOf) {
  Wrong out;
  for (size_t i = 0; i < lights.size(); ++i) {
    const std::span<const float> map = mapOf(lights[i], i);
    for (const SeenPoint& p : points) {
      if (!(shared::vplGeometry(lights[i], p.position, p.normal, p.normal, kClamp) > 0.0f))
        continue;
      const vec3 way = vec3(lights[i].position) - p.position;
      const float d = glm::length(way);
      const bool isDark = level.rays->occluded({p.position, 0.0f, way / d, d});
      const bool isStored = isInShadow(lights[i], map, p.position, p.normal, kBias);
      out.pairs += 1.0;
      out.lit += isDark && !isStored;
      out.dark += !isDark && isStored;
    }
  }
  return out;
}

struct Variant {
  const char* name;
  bool adapts, isTwoSided;
  ImperfectMapOptions map;
  uint32_t points = 8192;
};

void printWrongPairs(const Level& level) {
  using enum SplatShape;
  using enum HoleFilling;
  const std::vector<Variant> variants{
      {"uniform", false, false, {64, tilted, planes}},
      {"adaptive", true, false, {64, tilted, planes}},
      {"two-sided", true, true, {64, tilted, planes}},
      {"two-sided, 2k", true, true, {64, tilted, planes}, 2048},
      {"two-sided, 32k", true, true, {64, tilted, planes}, 32768},
      {"tilted, no filling", true, true, {64, tilted, none}},
      {"tilted, pull-push", true, true, {64, tilted, pullPush}},
      {"billboards, no filling", true, true, {64, billboard, none}},
      {"billboards, pull-push", true, true, {64, billboard, pullPush}}};
  std::vector<std::string> rows(variants.size() + 1);
  std::vector<double> mean(variants.size() + 1, 0.0);
  double micros = 0.0, maps = 0.0;
  for (const View& view : level.views) {
    const std::vector<shared::Vpl> lights = lightsOf(level, view);
    const std::vector<SeenPoint> seen = seenPoints(level.render, *level.rays, view, kPoints);
    std::vector<vec3> from, sending;
    for (const SeenPoint& p : seen) from.push_back(p.position);
    for (const shared::Vpl& v : lights) sending.emplace_back(v.position);
    RenderSceneChanges all;
    all.rebuilt = true;
    for (size_t k = 0; k < variants.size(); ++k) {
      const Variant& v = variants[k];
      OccluderPoints points;
      OccluderPointOptions options;
      options.pointsPerMap = v.points;
      options.points = 16 * v.points;
      points.update(level.render, all, v.adapts ? from : std::vector<vec3>(),
                    v.isTwoSided ? sending : std::vector<vec3>(), options);
      const OccluderPool pool = poolOf(points);
      ImperfectMap map(v.map);
      if (k == 2) {
        micros += 1e6 * processorSecondsOf([&] {
                    for (size_t i = 0; i < lights.size(); ++i) map.render(lights[i], pool.of(i));
                  });
        maps += static_cast<double>(lights.size());
      }
      const Wrong wrong = wrongPairs(level, lights, seen, [&](const shared::Vpl& l, size_t i) {
        return map.render(l, pool.of(i));
      });
      rows[k] += fmt::format(" {:.1f} ({:.1f}+{:.1f}) |", wrong.percent(),
                             100.0 * wrong.lit / std::max(wrong.pairs, 1.0),
                             100.0 * wrong.dark / std::max(wrong.pairs, 1.0));
      mean[k] += wrong.percent();
    }
    std::vector<float> traced(64 * 64);
    const Wrong wrong = wrongPairs(level, lights, seen, [&](const shared::Vpl& l, size_t) {
      cpu::traceShadowMap(*level.rays, l, 64, 0, 64, traced);
      return std::span<const float>(traced);
    });
    rows.back() += fmt::format(" {:.1f} |", wrong.percent());
    mean.back() += wrong.percent();
  }
  for (size_t k = 0; k < rows.size(); ++k)
    std::cout << fmt::format("| {} | {:.1f} |{}\n",
                             k < variants.size() ? variants[k].name : "traced",
                             mean[k] / static_cast<double>(level.views.size()), rows[k]);
  std::cout << fmt::format("\nA map: {:.0f} us of one core\n", micros / std::max(maps, 1.0));
}

void printTimes(const Level& level) {
  RenderSceneChanges all;
  all.rebuilt = true;
  ReflectiveMap map;
  const double walk =
      secondsOf([&] { map.update(level.render, *level.rays, all, {}, ReflectiveMapOptions()); });
  if (map.size() == 0 || level.views.empty()) return;
  const ViewSamples samples = raySamples(level.render, *level.rays, level.views.front(), kPoints);
  bidirectionalImportance(map, samples, kClamp);
  const double weigh = secondsOf([&] { bidirectionalImportance(map, samples, kClamp); });
  std::cout << fmt::format(
      "\n{} potential samples: traced in {:.1f} ms, weighed by {} view "
      "samples in {:.1f} ms\n",
      map.size(), 1e3 * walk, samples.size(), 1e3 * weigh);
}

int run(std::span<char*> arguments) {
  int views = 4;
  std::vector<fs::path> files;
  std::string moving, camera, picture;
  std::vector<std::string> set;
  for (size_t i = 0; i < arguments.size(); ++i) {
    const std::string_view flag = arguments[i];
    const bool hasValue = i + 1 < arguments.size();
    if (flag == "--views" && hasValue)
      views = std::stoi(arguments[++i]);
    else if (flag == "--moving" && hasValue)
      moving = arguments[++i];
    else if (flag == "--camera" && hasValue)
      camera = arguments[++i];
    else if (flag == "--picture" && hasValue)
      picture = arguments[++i];
    else if (flag == "--set" && hasValue)
      set.emplace_back(arguments[++i]);
    else
      files.emplace_back(flag);
  }
  if (!moving.empty()) {
    for (const fs::path& file : files) printMoving(file, camera, moving, set, picture);
    return 0;
  }
  const fs::path own = test::sourceFolder() / "assets/scenes", shared = test::sharedScenes();
  for (const fs::path& file :
       {own / "pillar_room.gltf", own / "u_corridor.gltf", own / "corridor_statue.gltf",
        shared / "zdm2-map/zdm2.glb", shared / "modern-hall/modern-hall.glb",
        shared / "classroom/classroom.gltf", shared / "bathroom/bathroom.glb"}) {
    const bool isWanted = files.empty() || std::ranges::any_of(files, [&](const fs::path& part) {
                            return file.string().find(part.string()) != std::string::npos;
                          });
    if (!isWanted || !fs::exists(file)) continue;
    Level level(file);
    if (static_cast<int>(level.views.size()) < views) {
      const auto more =
          insideViews(level.render, *level.rays, views - static_cast<int>(level.views.size()));
      level.views.insert(level.views.end(), more.begin(), more.end());
    }
    level.views.resize(std::min<size_t>(level.views.size(), static_cast<size_t>(views)));
    std::cout << fmt::format(
        "\n## {}, {} views\n\n| points | wrong pairs, % | by view (lit + dark) "
        "|\n| --- | --- | --- |\n",
        file.stem().string(), level.views.size());
    printWrongPairs(level);
    printTimes(level);
  }
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int count, char** arguments) {
  return lamplighter::run(std::span(arguments, static_cast<size_t>(count)).subspan(1));
}
