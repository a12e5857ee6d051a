// The error of many_lights against the path-traced reference over the number of VPLs, on every
// scene, with 0, 1 and 5 bounces. The loss by clamping is listed separately:
// docs/results/convergence.md.
//   lamplighter_convergence [--data FOLDER] [--carriers] [PART_OF_A_SCENE'S_PATH...]
// --carriers: instead, the error by what carries bounced light and that of the sky.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>

#include <spdlog/fmt/fmt.h>

#include "renderer/backends/cpu/cpu_backend.h"
#include "renderer/frame/frame.h"
#include "renderer/image/metrics.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/surface.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 160, kHeight = 100;
constexpr int kCounts[] = {64, 256, 1024, 4096, 16384};
constexpr int kBounces[] = {0, 1, 5};
// The reference is the mean of two pictures with this number of paths per pixel. Their difference
// gives its noise.
constexpr int kPaths = 256;
// many_lights averages this number of pictures with shifted pixels.
constexpr int kAntialias = 16;
// Distance so small that clamping removes almost nothing [m].
constexpr float kNoClamp = 0.1f;

// The view through the first camera, or from outside if there is none.
View viewOfScene(const Scene& scene) {
  for (const Node& node : scene.nodes)
    if (node.camera != kNone) return viewOfCamera(scene, node, kWidth, kHeight);
  RenderScene render;
  update(render, scene, SceneChanges::all());
  return viewOfBounds(render.bounds, kWidth, kHeight);
}

// 1 where one non-emissive surface covers the whole pixel. Edges and the picture of the light
// itself are excluded: they are not summed light, and their errors would dominate.
Image surfaceMask(const Scene& scene, const View& view) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  const RayCaster rays(render);
  const auto normalAt = [&](const Hit& hit) {
    return surfaceAt(render, hit.object, hit.triangle, hit.u, hit.v).geometricNormal;
  };
  const auto at = [&](float x, float y) {
    return rays.intersect(Ray{view.eye, 0.0f, view.rayDirection(x, y)}, Surfaces::seen);
  };
  Image mask(kWidth, kHeight);
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      const Hit middle = at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f);
      if (!middle || render.materials[render.objects[middle.object].material].emits()) continue;
      const vec3 normal = normalAt(middle);
      bool isOne = true;
      for (int i = 0; i < 16 && isOne; ++i) {
        const Hit hit = at(static_cast<float>(x) + static_cast<float>(i % 4) / 3.0f,
                           static_cast<float>(y) + static_cast<float>(i / 4) / 3.0f);
        isOne = hit && hit.object == middle.object && glm::dot(normalAt(hit), normal) > 0.9f;
      }
      if (isOne) mask.at(x, y) = vec3(1.0f);
    }
  }
  return mask;
}

Image settled(const Scene& scene, const View& view, const std::string& method,
              const Settings& settings) {
  FrameRenderer renderer(makeCpuBackend());
  SceneChanges changes = SceneChanges::all();
  GiOutput out;
  do {
    out = renderer.render({scene, changes, view, method, settings});
    changes = SceneChanges();
  } while (!out.settled);
  return out.radiance->pixels();
}

struct Reference {
  Image mean;
  double noise = 0.0;  // relRMSE of the mean that comes from its own noise
};

Reference reference(const Scene& scene, const View& view, const Image& mask, int bounces) {
  const auto half = [&](int seed) {
    Settings s;
    s.set("bounces", bounces);
    s.set("seed", seed);
    s.set("samples_per_pixel", kPaths);
    return settled(scene, view, "reference", s);
  };
  const Image a = half(1), b = half(2);
  Reference r{a, 0.5 * compareImages(a, b, &mask).relRmse};
  for (size_t i = 0; i < b.pixels.size(); ++i)
    r.mean.pixels[i] = 0.5f * (a.pixels[i] + b.pixels[i]);
  return r;
}

// For a level of 127,000 patches it takes many minutes to compute the visibility of each from
// 16,384 samples. Without it, the picture is the same (docs/results/equality.md).
std::string techniqueFor(const std::string& scene) {
  return scene == "zdm2" ? "naive"
                         : std::get<std::string>(manyLightsParameters()["technique"].defaultValue);
}

Image manyLights(const Scene& scene, const View& view, const std::string& technique, int bounces,
                 int vpls, std::optional<float> clampDistance = {}) {
  Settings s;
  s.set("technique", technique);
  s.set("bounces", bounces);
  s.set("vpls", vpls);
  s.set("updates", 65536);
  s.set("antialias", kAntialias);
  s.set("indirect", std::string("samples"));
  if (clampDistance) s.set("clamp_distance", *clampDistance);
  return settled(scene, view, "many_lights", s);
}

// Light samples of the table of carriers.
constexpr int kDefaultCount = 300;

// Its error, without the noise of the reference.
double errorOf(const Image& picture, const Reference& truth, const Image& mask) {
  const double all = compareImages(picture, truth.mean, &mask).relRmse;
  return std::sqrt(std::max(0.0, all * all - truth.noise * truth.noise));
}

void addCarriers(const fs::path& path) {
  const Scene scene = loadGltf(path).scene;
  const View view = viewOfScene(scene);
  const Image mask = surfaceMask(scene, view);
  for (const int bounces : kBounces) {
    const Reference truth = reference(scene, view, mask, bounces);
    std::string line = fmt::format("| {} | {} |", path.stem().string(), bounces);
    for (const auto& [method, indirect] : {std::pair("many_lights", "samples"),
                                           {"many_lights", "meshes"},
                                           {"multi_mesh", "meshes"},
                                           {"surface_shadow_maps", "samples"}}) {
      Settings s;
      s.set("bounces", bounces);
      s.set("vpls", kDefaultCount);
      s.set("antialias", kAntialias);
      s.set("indirect", std::string(indirect));
      const double error = errorOf(settled(scene, view, method, s), truth, mask);
      line += fmt::format(" {:.1f}% |", 100 * error);
    }
    std::cout << fmt::format("{} {:.1f}% |\n", line, 100 * truth.noise) << std::flush;
  }
}

void addScene(const fs::path& path, const fs::path& folder) {
  const Scene scene = loadGltf(path).scene;
  const View view = viewOfScene(scene);
  const Image mask = surfaceMask(scene, view);
  const std::string name = path.stem().string();
  for (const int bounces : kBounces) {
    const Reference truth = reference(scene, view, mask, bounces);
    std::string line = fmt::format("| {} | {} |", name, bounces);
    std::ofstream data;
    if (!folder.empty()) data.open(folder / fmt::format("{}.{}.tsv", name, bounces));
    Image last;
    for (const int vpls : kCounts) {
      last = manyLights(scene, view, techniqueFor(name), bounces, vpls);
      const double error = errorOf(last, truth, mask);
      line += fmt::format(" {:.1f}% |", 100 * error);
      data << vpls << '\t' << 100 * error << '\n';
    }
    const Image whole = manyLights(scene, view, techniqueFor(name), bounces,
                                   kCounts[std::size(kCounts) - 1], kNoClamp);
    const Metrics clamp = compareImages(last, whole, &mask);
    std::cout << fmt::format("{} {:+.1f}% | {:+.1f}% | {:.1f}% |\n", line,
                             100 * (compareImages(last, truth.mean, &mask).bias - 1),
                             100 * (clamp.bias - 1), 100 * truth.noise)
              << std::flush;
  }
}

int run(const std::vector<std::string>& arguments) {
  fs::path folder;
  bool ofCarriers = false;
  std::vector<std::string> wanted;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--data" && i + 1 < arguments.size())
      folder = arguments[++i];
    else if (arguments[i] == "--carriers")
      ofCarriers = true;
    else
      wanted.push_back(arguments[i]);
  }
  std::vector<fs::path> scenes = {test::sourceFolder() / "assets/scenes/default.gltf"};
  for (const auto& row : test::readTable(test::sharedScenes() / "scenes.tsv"))
    if (row.at("file").find("dungeon-kit") == std::string::npos)
      scenes.push_back(test::sharedScenes() / row.at("file"));
  if (ofCarriers) {
    std::cout << "\n| scene | bounces | `indirect=samples` | `indirect=meshes` | `multi_mesh` | "
                 "`surface_shadow_maps` | noise |\n| --- | --- | --- | --- | --- | --- | --- |\n";
  } else {
    std::cout << "\n| scene | bounces |";
    for (const int vpls : kCounts) std::cout << ' ' << vpls << " |";
    std::cout
        << " bias | of the clamp | noise |\n| --- | --- | --- | --- | --- | --- | --- | --- | "
           "--- | --- |\n";
  }
  for (const fs::path& scene : scenes) {
    const bool isWanted = std::any_of(wanted.begin(), wanted.end(), [&](const std::string& part) {
      return scene.string().find(part) != std::string::npos;
    });
    if (!wanted.empty() && !isWanted) continue;
    if (ofCarriers)
      addCarriers(scene);
    else
      addScene(scene, folder);
  }
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int argc, char** argv) {
  try {
    return lamplighter::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << "convergence: " << e.what() << '\n';
    return 2;
  }
}
