// What the parts of a light field cost, as in table 1 of paper 5, against rays of Embree, and how
// the cost depends on the number of lamps: docs/results/light_field.md.
//   lamplighter_light_field [PART_OF_A_SCENE'S_PATH...]
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "renderer/light_field/light_field.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/scenes/scenes.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

double secondsSince(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Level {
  explicit Level(Scene loaded) : scene(std::move(loaded)) {
    update(render, scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(render);
    RenderSceneChanges all;
    all.rebuilt = true;
    services.beginFrame(render, all, *rays, {}, true);
    field.outdate(all);
  }
  // Goes on until nothing is missing. Returns the seconds.
  double settle(const LightFieldOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    counts = {};
    lampRays = 0;
    do {
      field.update(render, services, options, kNoLimit);
      counts.add(field.counts().partners);
      lampRays += field.counts().lampRays;
    } while (!field.isDone());
    return secondsSince(start);
  }
  Scene scene;
  RenderScene render;
  std::unique_ptr<RayCaster> rays;
  Services services;
  LightField field;
  PartnerCounts counts;
  uint64_t lampRays = 0;
};

// Only what texels see: no lamps, no sky, no bounce.
LightFieldOptions partnersOnly(FieldSightChoice sight) {
  LightFieldOptions options;
  options.sight = sight;
  options.sets = 1;
  options.bounces = 0;
  options.showsBounces = options.showsSky = false;
  options.withLamps = true;
  return options;
}

void printTable(const std::vector<fs::path>& files) {
  std::cout
      << "## Parts\n\n| scene | triangles | texels (side) | texels, lines and lights | partners "
         "by lines | a second | rays among them | by rays | a second | gathers, 3 bounces | "
         "MB |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const fs::path& file : files) {
    Level level(loadGltf(file).scene);
    // Charts may be on disk or not: not counted.
    level.settle(partnersOnly(FieldSightChoice::lines));
    // Texels of the same side, and next to no directions.
    LightFieldOptions few = partnersOnly(FieldSightChoice::lines);
    few.divisions = 1;
    few.texel = level.field.texelSide();
    few.memory = size_t{1} << 40;
    const double prepared = level.settle(few);
    LightFieldOptions lines = partnersOnly(FieldSightChoice::lines);
    const double byLines = level.settle(lines) - prepared;
    const PartnerCounts counts = level.counts;
    LightFieldOptions lit = lines;
    lit.bounces = 3;
    lit.showsBounces = true;
    const double gathers = level.settle(lit);
    const size_t bytes = level.field.counts().bytes;
    const double byRays = level.settle(partnersOnly(FieldSightChoice::rays)) - prepared;
    const auto samples = static_cast<double>(counts.samples);
    std::cout
        << fmt::format(
               "| {} | {} | {} ({:.2f} m) | {:.2f} s | {:.2f} s | {:.1f} M | {:.1f}% | {:.2f} s "
               "| {:.1f} M | {:.0f} ms | {:.0f} |\n",
               file.stem().string(), level.render.triangleCount(), level.field.texels().size(),
               level.field.texelSide(), prepared, byLines, 1e-6 * samples / byLines,
               100.0 * static_cast<double>(counts.rays) / samples, byRays, 1e-6 * samples / byRays,
               1e3 * gathers, static_cast<double>(bytes) / (1 << 20))
        << std::flush;
  }
}

// A room with lamps on its ceiling, of the same area in all.
Scene roomWithLamps(int side) {
  Scene scene;
  test::addMesh(scene,
                test::roomMesh(vec3(8.0f, 3.0f, 8.0f), test::addMaterial(scene, vec3(0.7f))));
  test::addMesh(scene, test::boxMesh(vec3(1.0f), test::addMaterial(scene, vec3(0.5f))),
                vec3(0.0f, -1.0f, 0.0f));
  const float step = 7.0f / static_cast<float>(side);
  for (int k = 0; k < side * side; ++k)
    test::addRectangleLight(scene,
                            vec3(step * (static_cast<float>(k % side) + 0.5f) - 3.5f, 1.4f,
                                 step * (static_cast<float>(k / side) + 0.5f) - 3.5f),
                            vec2(0.5f * step), vec3(2.0f));
  return scene;
}

void printLamps() {
  std::cout
      << "\n## Lamps\n\n| lamps | `field_lamps=true`: all, and after a change of brightness | "
         "lamps by rays: all, rays, and after a change of brightness |\n| --- | --- | --- |\n";
  for (const int side : {1, 3, 10, 32}) {
    std::string row = fmt::format("| {} |", side * side);
    for (const bool withLamps : {true, false}) {
      Level level(roomWithLamps(side));
      LightFieldOptions options;
      options.sets = 1;
      options.withLamps = withLamps;
      const double all = level.settle(options);
      const uint64_t rays = level.lampRays;
      RenderSceneChanges gains;
      gains.gains = true;
      level.field.outdate(gains);
      const double again = level.settle(options);
      row += withLamps ? fmt::format(" {:.2f} s, {:.0f} ms |", all, 1e3 * again)
                       : fmt::format(" {:.2f} s, {:.1f} M rays, {:.0f} ms |", all,
                                     1e-6 * static_cast<double>(rays), 1e3 * again);
    }
    std::cout << row << "\n" << std::flush;
  }
}

int run(const std::vector<std::string>& wanted) {
  const fs::path own = test::sourceFolder() / "assets/scenes", shared = test::sharedScenes();
  std::vector<fs::path> files{own / "cornell_specular.gltf",
                              own / "pillar_room.gltf",
                              shared / "classroom/classroom.gltf",
                              shared / "modern-hall/modern-hall.glb",
                              shared / "living-room/living-room.gltf",
                              shared / "bathroom/bathroom.glb",
                              shared / "zdm2-map/zdm2.glb"};
  std::erase_if(files, [&](const fs::path& file) {
    return !fs::exists(file) ||
           (!wanted.empty() && std::ranges::none_of(wanted, [&](const std::string& part) {
             return file.string().find(part) != std::string::npos;
           }));
  });
  printTable(files);
  if (wanted.empty()) printLamps();
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int count, char** values) {
  return lamplighter::run(std::vector<std::string>(values + 1, values + count));
}
