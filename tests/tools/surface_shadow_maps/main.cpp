// Depths and links of texels, against the figures of paper 3: docs/results/surface_shadow_maps.md.
//   lamplighter_surface_shadow_maps [PART_OF_A_SCENE'S_PATH...]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <functional>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "renderer/base/random.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/surface_depths/surface_depths.h"
#include "renderer/surface_depths/texel_links.h"
#include "renderer/surface_depths/texel_sight.h"
#include "renderer/texels/texel_rays.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"

namespace lamplighter {
namespace {

namespace fs = std::filesystem;

constexpr int kBounces = 5;
constexpr float kAlbedo = 0.7f;
constexpr uint32_t kPairs = 1'000'000;

// A level, and the sides of texels with which it is measured [m].
struct Level {
  fs::path file;
  std::vector<float> texels;
};

double secondsOf(const std::function<void()>& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

struct Texels {
  Texels(const fs::path& file, float texel, TexelOrder order) {
    update(scene, loadGltf(file).scene, SceneChanges::all());
    rays = std::make_unique<RayCaster>(scene);
    set = TexelSet(scene, charts.find(scene, 1.0f / texel), order);
    set.findBuried(scene, *rays);
    tree = TexelTree(set);
  }
  SurfaceDepths depths(const DepthMapLayout& layout) const {
    SurfaceDepths out;
    out.restart(scene, set, layout);
    while (!out.isDone()) out.goOn(scene, *rays, set, ~uint64_t{0});
    return out;
  }
  TexelLinks links(float error, const Visibility& sees) const {
    TexelLinks out;
    out.restart(set, error);
    while (!out.isDone()) out.goOn(set, tree, sees, set.size());
    return out;
  }
  bool seesByRay(uint32_t texel, const vec3& point) const {
    return lamplighter::seesByRay(scene, *rays, set[texel], point);
  }
  // A texel by its area. `u`: in [0, 1).
  uint32_t at(float u) const {
    if (sums.empty())
      for (size_t t = 0; t < set.size(); ++t)
        sums.push_back((sums.empty() ? 0.0 : sums.back()) + static_cast<double>(set[t].area));
    return static_cast<uint32_t>(std::min<size_t>(
        static_cast<size_t>(std::ranges::upper_bound(sums, u * sums.back()) - sums.begin()),
        set.size() - 1));
  }

  RenderScene scene;
  std::unique_ptr<RayCaster> rays;
  ObjectCharts charts{fs::path()};
  TexelSet set;
  TexelTree tree;
  mutable std::vector<double> sums;  // of areas, by texel
};

// Table 2 of the paper: how well the orders compress.
void printOrders(const std::vector<Level>& levels) {
  std::cout
      << "\n| scene | texel | texels | map | pixels a segment: greedy | zigzag | spiral | of "
         "the memory of 16-bit maps | traced, s |\n| --- | --- | --- | --- | --- | --- | --- | "
         "--- | --- |\n";
  for (const Level& level : levels) {
    for (const float texel : level.texels) {
      for (const DepthMapLayout layout :
           {DepthMapLayout{DepthMapKind::cube, 32}, DepthMapLayout{DepthMapKind::octahedral, 64}}) {
        std::string line;
        size_t count = 0;
        double seconds = 0.0, memory = 0.0;
        for (const TexelOrder order :
             {TexelOrder::greedy, TexelOrder::zigzag, TexelOrder::spiral}) {
          const Texels texels(level.file, texel, order);
          SurfaceDepths depths;
          const double time = secondsOf([&] { depths = texels.depths(layout); });
          line += fmt::format(" {:.1f} |", static_cast<double>(depths.uncompressed()) /
                                               static_cast<double>(depths.segments()));
          if (order != TexelOrder::zigzag) continue;
          count = texels.set.size();
          seconds = time;
          memory = static_cast<double>(depths.bytes()) /
                   (sizeof(uint16_t) * static_cast<double>(depths.uncompressed()));
        }
        std::cout << fmt::format("| {} | {} m | {} | {} {} |{} {:.0f}% | {:.1f} |\n",
                                 level.file.stem().string(), texel, count,
                                 layout.kind == DepthMapKind::cube ? "cube" : "octahedral",
                                 layout.resolution, line, 100.0 * memory, seconds)
                  << std::flush;
      }
    }
  }
}

// Queries against rays, one after the other, on one core, between texels drawn by area.
void printQueries(const std::vector<Level>& levels) {
  std::cout << "\n| scene | texel | a query, ns | an occlusion ray, ns | answers that differ |\n| "
               "--- | --- | --- | --- | --- |\n";
  for (const Level& level : levels) {
    const float texel = level.texels.back();
    const Texels texels(level.file, texel, TexelOrder::zigzag);
    const SurfaceDepths depths = texels.depths({DepthMapKind::cube, 32});
    // As links ask: several senders for one receiver.
    std::vector<std::pair<uint32_t, uint32_t>> pairs;
    const auto random = [](uint32_t i, uint32_t set) {
      return static_cast<float>(hash4(i, 0, 0, set) >> 8) / 16777216.0f;
    };
    for (uint32_t i = 0; i < kPairs; ++i)
      pairs.emplace_back(texels.at(random(i / 64, 1)), texels.at(random(i, 2)));
    std::erase_if(pairs, [&](const auto& p) {
      const SurfaceTexel &a = texels.set[p.first], &b = texels.set[p.second];
      const vec3 d = b.spot.position - a.spot.position;
      return glm::dot(d, a.spot.geometricNormal) <= 1e-3f ||
             glm::dot(d, b.spot.geometricNormal) >= -1e-3f;
    });
    std::vector<uint8_t> stored(pairs.size()), traced(pairs.size());
    const double query = secondsOf([&] {
      for (size_t i = 0; i < pairs.size(); ++i)
        stored[i] = depths.sees(texels.set[pairs[i].first], pairs[i].first,
                                texels.set[pairs[i].second].spot.position);
    });
    const double ray = secondsOf([&] {
      for (size_t i = 0; i < pairs.size(); ++i)
        traced[i] = texels.seesByRay(pairs[i].first, texels.set[pairs[i].second].spot.position);
    });
    size_t differ = 0;
    for (size_t i = 0; i < pairs.size(); ++i) differ += stored[i] != traced[i];
    const auto total = static_cast<double>(pairs.size());
    std::cout << fmt::format("| {} | {} m | {:.0f} | {:.0f} | {:.2f}% |\n",
                             level.file.stem().string(), texel, 1e9 * query / total,
                             1e9 * ray / total, 100.0 * static_cast<double>(differ) / total)
              << std::flush;
  }
}

// The irradiance of bounced light, if each texel emits as it faces a point in the middle above.
std::vector<vec3> bounced(const Texels& texels, const TexelLinks& links,
                          double* seconds = nullptr) {
  std::vector<vec3> light(texels.set.size(), vec3(0.0f)), radiosity(light.size()), byNode;
  const vec3 lamp =
      texels.scene.bounds.centre() + 0.2f * vec3(0.0f, texels.scene.bounds.extent().y, 0.0f);
  const double time = secondsOf([&] {
    for (int b = 0; b < kBounces; ++b) {
      for (size_t t = 0; t < light.size(); ++t) {
        const SurfaceSpot& spot = texels.set[t].spot;
        const vec3 d = lamp - spot.position;
        const float direct =
            std::max(0.0f, glm::dot(spot.normal, d)) / std::pow(1.0f + glm::dot(d, d), 1.5f);
        radiosity[t] = kAlbedo * (vec3(direct) + light[t]);
      }
      texels.tree.pull(radiosity, byNode);
      links.gather(byNode, light);
    }
  });
  if (seconds) *seconds = time;
  return light;
}

// By area, without buried texels.
double errorOf(const Texels& texels, const std::vector<vec3>& light,
               const std::vector<vec3>& truth) {
  double squares = 0.0, mean = 0.0, area = 0.0;
  for (size_t t = 0; t < light.size(); ++t) {
    if (texels.set.isBuried(t)) continue;
    const auto own = static_cast<double>(texels.set[t].area);
    squares += own * std::pow(static_cast<double>(light[t].g - truth[t].g), 2.0);
    mean += own * static_cast<double>(truth[t].g);
    area += own;
  }
  return std::sqrt(squares / area) / (mean / area);
}

void printLinks(const std::vector<Level>& levels) {
  std::cout
      << "\n| scene | texels | link_error | links per texel | found, s | per bounce, ms | relRMSE "
         "| by rays instead of depths |\n| --- | --- | --- | --- | --- | --- | --- | --- |\n";
  for (const Level& level : levels) {
    const Texels texels(level.file, level.texels.back(), TexelOrder::zigzag);
    const SurfaceDepths depths = texels.depths({DepthMapKind::cube, 32});
    const Visibility stored = [&](uint32_t t, const vec3& point) {
      return depths.sees(texels.set[t], t, point);
    };
    const Visibility traced = [&](uint32_t t, const vec3& point) {
      return texels.seesByRay(t, point);
    };
    // All pairs, where that is feasible.
    const bool hasTruth = texels.set.size() < 8000;
    const std::vector<vec3> truth =
        hasTruth ? bounced(texels, texels.links(0.0f, stored)) : std::vector<vec3>();
    for (const float error : {0.02f, 0.005f, 0.002f}) {
      TexelLinks links;
      const double seconds = secondsOf([&] { links = texels.links(error, stored); });
      double bounces = 0.0;
      const std::vector<vec3> light = bounced(texels, links, &bounces);
      const std::vector<vec3> byRays = bounced(texels, texels.links(error, traced));
      std::cout << fmt::format(
                       "| {} | {} | {}% | {:.0f} | {:.2f} | {:.1f} | {} | {:.2f}% |\n",
                       level.file.stem().string(), texels.set.size(), 100.0f * error,
                       static_cast<double>(links.size()) / static_cast<double>(texels.set.size()),
                       seconds, 1e3 * bounces / kBounces,
                       hasTruth ? fmt::format("{:.2f}%", 100.0 * errorOf(texels, light, truth))
                                : "",
                       100.0 * errorOf(texels, light, byRays))
                << std::flush;
    }
  }
}

int run(const std::vector<std::string>& wanted) {
  const fs::path own = test::sourceFolder() / "assets/scenes", shared = test::sharedScenes();
  std::vector<Level> levels{{shared / "cornell-box/cornell-box.glb", {0.2f, 0.1f, 0.05f}},
                            {own / "pillar_room.gltf", {0.3f}},
                            {shared / "modern-hall/modern-hall.glb", {0.4f}},
                            {shared / "kenney-fps-level/kenney-fps-level.gltf", {0.6f}}};
  std::erase_if(levels, [&](const Level& level) {
    return !fs::exists(level.file) ||
           (!wanted.empty() && std::ranges::none_of(wanted, [&](const std::string& part) {
             return level.file.string().find(part) != std::string::npos;
           }));
  });
  printOrders(levels);
  printQueries(levels);
  // Below 8,000 texels, so that all pairs are feasible.
  for (Level& level : levels)
    if (level.texels.size() > 1) level.texels.pop_back();
  printLinks(levels);
  return 0;
}

}  // namespace
}  // namespace lamplighter

int main(int count, char** values) {
  return lamplighter::run(std::vector<std::string>(values + 1, values + count));
}
