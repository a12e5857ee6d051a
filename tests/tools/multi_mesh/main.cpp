// What multi_mesh computes, against the figures and claims of paper 4: docs/results/multi_mesh.md.
//   lamplighter_multi_mesh [PART_OF_A_SCENE'S_PATH...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

// The size of the paper's pictures.
constexpr int kWidth = 640, kHeight = 480;
// Of the vertices that a picture needs, the shares at which priorities are compared.
constexpr double kShares[] = {0.1, 0.25, 0.5, 0.75};

struct Work {
  int frames = 0;
  double seconds = 0.0;  // of all frames
  double samples = 0.0, masks = 0.0, open = 0.0, rays = 0.0, corners = 0.0, allRays = 0.0;
  GiOutput last;

  void add(const GiOutput& out) {
    samples += out.stats.of("direct_samples");
    masks += out.stats.of("direct_masks");
    open += out.stats.of("direct_open");
    rays += out.stats.of("direct_rays");
    allRays += static_cast<double>(out.stats.raysTraced);
    ++frames;
    last = out;
  }
};

// A scene through its first camera, shown by multi_mesh.
class Shown {
 public:
  explicit Shown(const fs::path& path) : scene(loadGltf(path).scene) {
    update(world_, scene, SceneChanges::all());
    view = viewOfBounds(world_.bounds, kWidth, kHeight);
    for (const Node& node : scene.nodes)
      if (node.camera != kNone) view = viewOfCamera(scene, node, kWidth, kHeight);
    settings.set("antialias", 1);
  }

  // Until the picture is settled. `each`: of each frame.
  template <typename Each>
  Work settle(SceneChanges changes, const Each& each) {
    Work work;
    do {
      const auto start = std::chrono::steady_clock::now();
      const GiOutput out = renderer_.render({scene, changes, view, "multi_mesh", settings});
      work.seconds +=
          std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      changes = {};
      work.add(out);
      each(work);
    } while (!work.last.settled);
    return work;
  }
  Work settle(const SceneChanges& changes = {}) {
    return settle(changes, [](const Work&) {});
  }
  Work edit(const Scene& other) {
    const Scene old = std::exchange(scene, other);
    return settle(compare(old, scene));
  }
  // Nodes of rectangle lights, discs and spheres that shine.
  std::vector<NodeId> areaLights() const {
    std::vector<NodeId> nodes;
    for (const Node& node : scene.nodes)
      if (node.area && node.visible) nodes.push_back(node.id);
    return nodes;
  }
  size_t triangles() const { return world_.indices.size() / 3; }

  Scene scene;
  View view;
  Settings settings;

 private:
  RenderScene world_;
  FrameRenderer renderer_{makeCpuBackend()};
};

// Figure 4 and section 5 of the paper: how many samples, and how they were found.
void printCounts(const std::vector<fs::path>& scenes) {
  std::cout
      << "\n| scene | triangles | area lights | vertices lit | open | by mask | by rays | "
         "direct light, s | corners of elements | gather rays | whole picture, s | the camera "
         "returns, ms |\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | "
         "--- |\n";
  for (const fs::path& path : scenes) {
    Shown direct(path);
    direct.settings.set("bounces", 0);
    const Work w = direct.settle(SceneChanges::all());
    Shown shown(path);
    const Work all = shown.settle(SceneChanges::all());
    const View view = shown.view;
    shown.view.eye += 0.05f * shown.view.forward();
    shown.settle();
    shown.view = view;
    const Work back = shown.settle();
    const double byRays = std::max(0.0, w.samples - w.open - w.masks);
    std::cout << fmt::format(
                     "| {} | {} | {} | {:.0f} | {:.0f}% | {:.0f}% | {:.0f}% | {:.2f} | {:.0f} | "
                     "{:.2f}M | {:.2f} | {:.0f} |\n",
                     path.stem().string(), direct.triangles(), w.last.stats.of("light_meshes"),
                     w.samples, 100 * w.open / std::max(1.0, w.samples),
                     100 * w.masks / std::max(1.0, w.samples),
                     100 * byRays / std::max(1.0, w.samples), w.seconds,
                     all.last.stats.of("element_corners"), 1e-6 * (all.allRays - all.rays),
                     all.seconds, 1e3 * back.seconds / back.frames)
              << std::flush;
  }
}

// Section 4: what is shown after a part of the samples, by their order.
void printPriorities(const std::vector<fs::path>& scenes) {
  std::cout << "\n| scene | priority |";
  for (const double share : kShares) std::cout << fmt::format(" {:.0f}% |", 100 * share);
  std::cout << " vertices |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  for (const fs::path& path : scenes) {
    Shown known(path);
    known.settings.set("bounces", 0);
    const Work all = known.settle(SceneChanges::all());
    const Image truth = all.last.radiance->pixels();
    for (const std::string priority : {"paper", "sorted", "random"}) {
      Shown shown(path);
      shown.settings.set("bounces", 0);
      shown.settings.set("priority", priority);
      shown.settings.set("updates", 16);
      std::vector<std::pair<double, double>> errors;  // share, error
      shown.settle(SceneChanges::all(), [&](const Work& work) {
        errors.emplace_back(work.samples / all.samples,
                            compareImages(work.last.radiance->pixels(), truth).relRmse);
      });
      std::string line = fmt::format("| {} | {} |", path.stem().string(), priority);
      for (const double share : kShares) {
        const auto at =
            std::ranges::find_if(errors, [&](const auto& e) { return e.first > share; });
        line += at == errors.end() ? " |" : fmt::format(" {:.1f}% |", 100 * at->second);
      }
      std::cout << fmt::format("{} {:.0f} |\n", line, all.samples) << std::flush;
    }
  }
}

// Section 3: a mesh for each light, or one for all: vertices that are computed again after edits.
void printSeparation(const std::vector<fs::path>& scenes) {
  std::cout << "\n| scene | meshes | at first | first light brighter | first light moved | all "
               "lights off but one |\n| --- | --- | --- | --- | --- | --- |\n";
  for (const fs::path& path : scenes) {
    for (const bool isSeparate : {true, false}) {
      Shown shown(path);
      const std::vector<NodeId> lights = shown.areaLights();
      if (lights.size() < 2) break;
      shown.settings.set("bounces", 0);
      shown.settings.set("separate_lights", isSeparate);
      const double first = shown.settle(SceneChanges::all()).samples;
      Scene brighter = shown.scene;
      brighter.find(lights[0])->area->radiance *= 1.5f;
      const double dimmed = shown.edit(brighter).samples;
      Scene moved = shown.scene;
      moved.find(lights[0])->local.translation.y -= 0.1f;
      const double ofMove = shown.edit(moved).samples;
      Scene one = shown.scene;
      for (size_t i = 1; i < lights.size(); ++i) one.find(lights[i])->visible = false;
      const double ofSolo = shown.edit(one).samples;
      std::cout << fmt::format("| {} | {} | {:.0f} | {:.0f} | {:.0f} | {:.0f} |\n",
                               path.stem().string(), isSeparate ? "one for each light" : "one",
                               first, dimmed, ofMove, ofSolo)
                << std::flush;
    }
  }
}

// Section 5: what the plane of 160° misses of bounced light.
void printProjections(const std::vector<fs::path>& scenes) {
  std::cout << "\n| scene | bounces | bounced light by the plane, of that of the hemisphere |\n| "
               "--- | --- | --- |\n";
  for (const fs::path& path : scenes) {
    for (const int bounces : {1, 5}) {
      double light[2] = {0.0, 0.0};
      for (const bool isPlane : {false, true}) {
        double sum[2] = {0.0, 0.0};
        for (const bool isBounced : {false, true}) {
          Shown shown(path);
          shown.settings.set("bounces", isBounced ? bounces : 0);
          shown.settings.set("projection", std::string(isPlane ? "plane" : "hemisphere"));
          const Work work = shown.settle(SceneChanges::all());
          for (const vec3& p : work.last.radiance->pixels().pixels)
            sum[isBounced] += static_cast<double>(luminance(p));
        }
        light[isPlane] = sum[1] - sum[0];
      }
      std::cout << fmt::format("| {} | {} | {:.2f}% |\n", path.stem().string(), bounces,
                               100 * light[1] / light[0])
                << std::flush;
    }
  }
}

int run(const std::vector<std::string>& wanted) {
  std::vector<fs::path> scenes;
  for (const char* name : {"area_light_room", "table_room", "default", "pillar_room"})
    scenes.push_back(test::sourceFolder() / "assets/scenes" / (std::string(name) + ".gltf"));
  for (const char* name : {"cornell-box/cornell-box.glb", "modern-hall/modern-hall.glb"})
    scenes.push_back(test::sharedScenes() / name);
  std::erase_if(scenes, [&](const fs::path& path) {
    return !fs::exists(path) ||
           (!wanted.empty() && std::ranges::none_of(wanted, [&](const std::string& part) {
             return path.string().find(part) != std::string::npos;
           }));
  });
  printCounts(scenes);
  printSeparation(scenes);
  // The hall would take many minutes more.
  std::erase_if(scenes, [](const fs::path& path) { return path.stem() == "modern-hall"; });
  printPriorities(scenes);
  printProjections(scenes);
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int count, char** values) {
  return lamplighter::run(std::vector<std::string>(values + 1, values + count));
}
