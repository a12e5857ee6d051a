// How far the techniques `visibility` and `light_maps` are from `naive` with the same VPLs,
// settled, on every scene, from every camera and from outside, on both backends: docs/equality.md.
//   lamplighter_equality [--pictures FOLDER] [PART_OF_A_SCENE'S_PATH...]
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/backends/gl/gl_backend.h"
#include "renderer/error.h"
#include "renderer/frame.h"
#include "renderer/image/image_io.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/gltf_io.h"
#include "tests/support/shared_files.h"
#include "tests/support/traced_shadows.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 320, kHeight = 200;
constexpr double kLimit = 0.01;
constexpr int kResolutions[] = {64, 256};
const std::string kNaive = "naive", kVisibility = "visibility", kLightMaps = "light_maps";

struct NamedView {
  std::string name;
  View view;
};

std::vector<NamedView> viewsOf(const Scene& scene) {
  std::vector<NamedView> views;
  for (const Node& node : scene.nodes) {
    if (node.camera == kNone) continue;
    const std::string name = node.name.empty() ? scene.cameras[node.camera].name : node.name;
    views.push_back({name.empty() ? "camera" : name, viewOfCamera(scene, node, kWidth, kHeight)});
  }
  RenderScene render;
  update(render, scene, SceneChanges::all());
  views.push_back({"all of it", viewOfBounds(render.bounds, kWidth, kHeight)});
  return views;
}

// What its size lets be done in a while.
int vplsFor(size_t triangles) { return triangles < 10000 ? 300 : 100; }

constexpr float kFineTexel = 0.02f;  // [m], where it is asked whether the light maps' texels do it

Settings settingsOf(const std::string& technique, int resolution, int vpls) {
  Settings s;
  s.set(parameters::technique().name, technique);
  s.set(parameters::mapResolution().name, resolution);
  s.set(parameters::vpls().name, vpls);
  s.set(parameters::updates().name, 65536);
  s.set(parameters::antialias().name, 1);
  return s;
}

Image settled(FrameRenderer& renderer, const Scene& scene, SceneChanges changes, const View& view,
              const Settings& settings) {
  GiOutput out;
  do {
    out = renderer.render({scene, changes, view, "many_lights", settings});
    changes = SceneChanges();
  } while (!out.settled);
  return out.radiance->pixels();
}

// By technique and resolution, then view.
using Pictures = std::map<std::pair<std::string, int>, std::vector<Image>>;

Pictures rendered(std::unique_ptr<Backend> backend, const Scene& scene,
                  const std::vector<NamedView>& views, int vpls) {
  FrameRenderer renderer(std::move(backend));
  SceneChanges changes = SceneChanges::all();
  Pictures pictures;
  // In this order so that what each keeps is of use to the next.
  for (const auto& [technique, resolution] : {std::pair(kNaive, 64),
                                              {kNaive, 256},
                                              {kVisibility, 256},
                                              {kLightMaps, 256},
                                              {kLightMaps, 64},
                                              {kVisibility, 64}}) {
    const Settings settings = settingsOf(technique, resolution, vpls);
    for (const NamedView& v : views) {
      pictures[{technique, resolution}].push_back(
          settled(renderer, scene, changes, v.view, settings));
      changes = SceneChanges();
    }
  }
  return pictures;
}

struct Row {
  std::string scene, view, backend;
  int resolution;
  double naive = 0, visibility = 0, lightMaps = 0;  // from traced shadows
  double fine = 0;                                  // light_maps of fine texels, from naive
};

class Table {
 public:
  explicit Table(fs::path folder) : folder_(std::move(folder)) {
    std::cout << "\n| scene | view | VPLs |";
    for (const char* backend : {"cpu", "gl"})
      for (const int resolution : kResolutions)
        for (const std::string& technique : {kVisibility, kLightMaps})
          std::cout << fmt::format(" {} {}² {} |", backend, resolution, technique);
    std::cout << "\n| --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |\n";
  }

  void add(const fs::path& path) {
    const Scene scene = loadGltf(path).scene;
    RenderScene render;
    update(render, scene, SceneChanges::all());
    const int vpls = vplsFor(render.indices.size() / 3);
    const std::vector<NamedView> views = viewsOf(scene);
    const std::string name = path.stem().string();
    std::map<std::string, Pictures> pictures;
    pictures["cpu"] = rendered(makeCpuBackend(), scene, views, vpls);
    pictures["gl"] = rendered(makeGlBackend(), scene, views, vpls);
    for (size_t v = 0; v < views.size(); ++v) {
      std::string line = fmt::format("| {} | {} | {} |", name, views[v].name, vpls);
      for (auto& [backend, of] : pictures)
        for (const int resolution : kResolutions)
          line += compare({name, views[v].name, backend, resolution}, of, v, scene, views[v].view,
                          vpls);
      std::cout << line << std::endl;  // it takes long: whoever looks on sees each
    }
  }

  // Whether those that are over the limit are nearer to what is right.
  void finish() const {
    std::cout << fmt::format(
        "\n{} of {} pictures are under {:.0f}%, the largest of all is {:.2f}%.\n", under_, all_,
        100 * kLimit, 100 * most_);
    if (over_.empty()) return;
    std::cout
        << "\n| scene | view | backend | maps | naive | visibility | light_maps | fine texels |\n"
           "| --- | --- | --- | --- | --- | --- | --- | --- |\n";
    for (const Row& r : over_)
      std::cout << fmt::format("| {} | {} | {} | {}² | {:.2f}% | {:.2f}% | {:.2f}% | {:.2f}% |\n",
                               r.scene, r.view, r.backend, r.resolution, 100 * r.naive,
                               100 * r.visibility, 100 * r.lightMaps, 100 * r.fine);
  }

 private:
  std::string compare(Row row, const Pictures& of, size_t view, const Scene& scene,
                      const View& camera, int vpls) {
    const Image& naive = of.at({kNaive, row.resolution})[view];
    std::string cells;
    bool over = false;
    for (const std::string& technique : {kVisibility, kLightMaps}) {
      const double error = compareImages(of.at({technique, row.resolution})[view], naive).relRmse;
      const bool isOver = !(error < kLimit);
      cells += isOver ? fmt::format(" **{:.2f}%** |", 100 * error)
                      : fmt::format(" {:.2f}% |", 100 * error);
      ++all_;
      under_ += !isOver;
      most_ = std::max(most_, error);
      over = over || isOver;
    }
    if (!over) return cells;
    const Image truth =
        test::withTracedShadows(scene, camera, settingsOf(kNaive, row.resolution, vpls));
    const auto distance = [&](const std::string& technique) {
      const Image& picture = of.at({technique, row.resolution})[view];
      if (!folder_.empty()) {
        const std::string stem =
            fmt::format("{}.{}.{}.{}.", row.scene, row.view, row.backend, row.resolution);
        writeExr(picture, folder_ / (stem + technique + ".exr"));
        writeExr(truth, folder_ / (stem + "traced.exr"));
      }
      return compareImages(picture, truth).relRmse;
    };
    row.naive = distance(kNaive);
    row.visibility = distance(kVisibility);
    row.lightMaps = distance(kLightMaps);
    Settings fine = settingsOf(kLightMaps, row.resolution, vpls);
    fine.set(parameters::lightMapTexel().name, kFineTexel);
    FrameRenderer renderer(row.backend == "cpu" ? makeCpuBackend() : makeGlBackend());
    row.fine =
        compareImages(settled(renderer, scene, SceneChanges::all(), camera, fine), naive).relRmse;
    over_.push_back(row);
    return cells;
  }

  fs::path folder_;
  std::vector<Row> over_;
  int all_ = 0, under_ = 0;
  double most_ = 0.0;
};

int run(const std::vector<std::string>& arguments) {
  fs::path folder;
  std::vector<std::string> wanted;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--pictures" && i + 1 < arguments.size())
      folder = arguments[++i];
    else
      wanted.push_back(arguments[i]);
  }
  std::vector<fs::path> scenes;
  for (const auto& entry :
       fs::directory_iterator(fs::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes"))
    if (entry.path().extension() == ".gltf") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& row : test::readTable(test::sharedScenes() / "scenes.tsv"))
    scenes.push_back(test::sharedScenes() / row.at("file"));
  const gl::HeadlessContext context;
  Table table(folder);
  for (const fs::path& scene : scenes) {
    const bool isWanted = std::any_of(wanted.begin(), wanted.end(), [&](const std::string& part) {
      return scene.string().find(part) != std::string::npos;
    });
    if (wanted.empty() || isWanted) table.add(scene);
  }
  table.finish();
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int argc, char** argv) {
  try {
    return lamplighter::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << "equality: " << e.what() << '\n';
    return 2;
  }
}
