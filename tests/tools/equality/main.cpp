// Prints the summary of docs/results/equality.md: the difference between many_lights and `naive`
// with the same VPLs, settled, on every scene, from every camera and from outside, on both
// backends. It tests the techniques `visibility` and `light_maps` at full resolution, and the
// default settings. The summary goes to standard output, the figures of each picture to standard
// error.
//   lamplighter_equality [--pictures FOLDER] [--maps N,...] [--tables N,...] [PART_OF_A_PATH...]
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <map>

#include <CLI/CLI.hpp>
#include <spdlog/fmt/fmt.h>

#include "renderer/gl/headless_context.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/gltf/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/support/folders.h"
#include "tests/support/shared_files.h"
#include "tests/tools/equality/comparison.h"

namespace lamplighter::equality {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kBackends = {"cpu", "gl"};
// texels per side of maps at rest; the first is used for all tables
using Resolutions = std::vector<int>;

constexpr int kGroupedVpls = 800;  // VPLs are grouped if there are at least this many

// A number of VPLs that a scene of this size can render in reasonable time.
int fewVpls(size_t triangles) { return triangles < 10000 ? 300 : 100; }
int defaultVpls(size_t) { return ManyLightsParameters().vpls; }
int groupedVpls(size_t) { return kGroupedVpls; }

Column column(const std::string& backend, int resolution, const std::string& name, int vpls,
              const std::string& technique) {
  Column c{backend, resolution, name, naiveSettings(resolution, vpls)};
  c.settings.set("technique", technique);
  return c;
}

// Full resolution, without groups.
std::vector<Column> shadowColumns(int vpls, const Resolutions& resolutions) {
  std::vector<Column> columns;
  for (const std::string& backend : kBackends)
    for (const int resolution : resolutions)
      for (const std::string technique : {"visibility", "light_maps"}) {
        Column c = column(backend, resolution, technique, vpls, technique);
        c.settings.set("block", std::string("1"));
        c.settings.set("group_share", 0.0f);
        columns.push_back(c);
      }
  return columns;
}

// With the low-resolution pass.
std::vector<Column> allColumns(int vpls, const Resolutions& resolutions) {
  std::vector<Column> columns;
  for (const std::string& backend : kBackends)
    for (const int resolution : resolutions)
      columns.push_back(column(backend, resolution, "all", vpls, "light_maps"));
  return columns;
}

// With this number of VPLs, other columns take too long.
std::vector<Column> groupColumns(int vpls, const Resolutions& resolutions) {
  std::vector<Column> columns = allColumns(vpls, resolutions);
  std::erase_if(columns, [&](const Column& c) { return c.resolution != resolutions[0]; });
  return columns;
}

Column transferColumn(const std::string& backend, int vpls, const Resolutions& resolutions) {
  Column c = column(backend, resolutions[0], "prt", vpls, "light_maps");
  c.settings.set("prt", true);
  return c;
}

// The light of the same samples: samples on a mesh light that mesh, as in `naive`.
std::vector<Column> transferColumns(int vpls, const Resolutions& resolutions) {
  std::vector<Column> columns;
  for (const std::string& backend : kBackends)
    columns.push_back(transferColumn(backend, vpls, resolutions));
  return columns;
}

// Reflection between parts of a mesh is different light than that of samples on the mesh.
std::vector<Column> reflectionColumns(int vpls, const Resolutions& resolutions) {
  Column c = transferColumn("cpu", vpls, resolutions);
  c.settings.set("prt_bounces", 4);
  return {c};
}

struct Kind {
  std::string title;
  double limit;
  int (*vpls)(size_t triangles);
  std::vector<Column> (*columns)(int vpls, const Resolutions&);
};

const Kind kKinds[] = {{"full resolution", 0.01, fewVpls, shadowColumns},
                       {"default", 0.03, defaultVpls, allColumns},
                       {"groups", 0.03, groupedVpls, groupColumns},
                       {"transfer", 0.03, defaultVpls, transferColumns},
                       {"reflections", 0.03, defaultVpls, reflectionColumns}};

size_t trianglesOf(const Scene& scene) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  return render.indices.size() / 3;
}

void rule(std::ostream& out, size_t columns) {
  for (size_t i = 0; i < columns; ++i) out << "| --- ";
  out << "|\n";
}

// Prints the pictures above the limit, with the errors of both techniques against ray tracing.
void printOver(const std::vector<Over>& over) {
  std::cerr
      << "\n| scene | view | backend | maps | technique | from naive | naive from rays | from "
         "rays | database |\n";
  rule(std::cerr, 9);
  for (const Over& o : over)
    std::cerr << fmt::format(
        "| {} | {} | {} | {}² | {} | {:.2f}% | {:.2f}% | {:.2f}% | {:.3f}% |\n", o.scene, o.view,
        o.column.backend, o.column.resolution, o.column.name, 100 * o.error, 100 * o.naiveFromRays,
        100 * o.fromRays, 100 * o.database);
}

std::string percent(double error, double limit) {
  const char* mark = error < limit ? "" : "**";
  return fmt::format(" {}{:.2f}%{} |", mark, 100 * error, mark);
}

// Statistics of all pictures of one kind with one resolution of the maps.
struct Tally {
  size_t all = 0, under = 0;
  double most = 0.0;
};

// The result of one table: the largest error of each scene, at the first resolution.
struct Result {
  const Kind* kind;
  std::map<std::string, double> worst;
  std::map<int, Tally, std::greater<>> tallies;  // by resolution
};

// The small scenes of one folder share one row of the summary.
std::string rowOf(const fs::path& path) {
  const std::string folder = path.parent_path().filename();
  return folder == "dungeon-kit" ? folder : path.stem().string();
}

// Prints the whole table to standard error row by row, because it takes long.
Result measure(const Kind& kind, const std::vector<fs::path>& scenes,
               const Resolutions& resolutions, const fs::path& folder) {
  const std::vector<Column> header = kind.columns(1, resolutions);
  std::cerr << "\n## " << kind.title << "\n\n| scene | view | VPLs |";
  for (const Column& c : header)
    std::cerr << fmt::format(" {} {}² {} |", c.backend, c.resolution, c.name);
  std::cerr << '\n';
  rule(std::cerr, 3 + header.size());
  Result result{&kind, {}, {}};
  std::vector<Over> over;
  for (const fs::path& path : scenes) {
    const Scene scene = loadGltf(path).scene;
    const std::string name = path.stem().string();
    const int vpls = kind.vpls(trianglesOf(scene));
    const Compared compared =
        compare(name, scene, vpls, kind.columns(vpls, resolutions), kind.limit, folder);
    double& worst = result.worst[rowOf(path)];
    for (const Row& row : compared.rows) {
      std::cerr << fmt::format("| {} | {} | {} |", name, row.view, vpls);
      for (size_t i = 0; i < row.errors.size(); ++i) {
        const double error = row.errors[i];
        std::cerr << percent(error, kind.limit);
        Tally& tally = result.tallies[header[i].resolution];
        tally.most = std::max(tally.most, error);
        ++tally.all;
        tally.under += error < kind.limit ? 1 : 0;
        if (header[i].resolution == resolutions[0]) worst = std::max(worst, error);
      }
      std::cerr << std::endl;
    }
    over.insert(over.end(), compared.over.begin(), compared.over.end());
  }
  if (!over.empty()) printOver(over);
  return result;
}

// Prints the largest error of each scene over its views and both backends, by table.
void printSummary(const std::vector<fs::path>& scenes, const std::vector<Result>& results) {
  std::cout << "\n| scene |";
  for (const Result& r : results) std::cout << ' ' << r.kind->title << " |";
  std::cout << '\n';
  rule(std::cout, 1 + results.size());
  std::string last;
  for (const fs::path& path : scenes) {
    const std::string row = rowOf(path);
    if (row == last) continue;
    last = row;
    std::cout << "| " << row << " |";
    for (const Result& r : results) std::cout << percent(r.worst.at(row), r.kind->limit);
    std::cout << '\n';
  }
  std::cout << "\n| | maps | under the limit | largest |\n";
  rule(std::cout, 4);
  for (const Result& r : results)
    for (const auto& [resolution, tally] : r.tallies)
      std::cout << fmt::format("| {} | {}² | {} of {} under {:.0f}% | {:.2f}% |\n", r.kind->title,
                               resolution, tally.under, tally.all, 100 * r.kind->limit,
                               100 * tally.most);
}

struct Options {
  fs::path folder;  // for pictures; empty: none
  Resolutions resolutions{384, 64};
  std::vector<int> tables{1, 2, 3, 4, 5};
  std::vector<std::string> wanted;  // parts of paths; none: all scenes
};

void run(const Options& options) {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(test::sourceFolder() / "assets/scenes"))
    if (entry.path().extension() == ".gltf") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& row : test::readTable(test::sharedScenes() / "scenes.tsv"))
    scenes.push_back(test::sharedScenes() / row.at("file"));
  if (!options.wanted.empty())
    std::erase_if(scenes, [&](const fs::path& scene) {
      return std::ranges::none_of(options.wanted, [&](const std::string& part) {
        return scene.string().find(part) != std::string::npos;
      });
    });
  const gl::HeadlessContext context;
  std::vector<Result> results;
  for (const int table : options.tables)
    results.push_back(measure(kKinds[table - 1], scenes, options.resolutions, options.folder));
  printSummary(scenes, results);
}

}  // namespace
}  // namespace lamplighter::equality

int main(int argc, char** argv) {
  lamplighter::equality::Options options;
  CLI::App app("Each technique against naive: docs/results/equality.md");
  app.add_option("--pictures", options.folder, "Folder for pictures of what is over its limit");
  app.add_option("--maps", options.resolutions, "Texels per side of the shadow maps at rest")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(8, 1024))
      ->capture_default_str();
  app.add_option("--tables", options.tables, "Numbers of the tables")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(CLI::Range(1, 5))
      ->capture_default_str();
  app.add_option("scenes", options.wanted, "Parts of paths of scenes; without: all");
  CLI11_PARSE(app, argc, argv);
  try {
    if (!options.folder.empty()) std::filesystem::create_directories(options.folder);
    lamplighter::equality::run(options);
    return 0;
  } catch (const std::exception& e) {
    std::cerr << "equality: " << e.what() << '\n';
    return 2;
  }
}
