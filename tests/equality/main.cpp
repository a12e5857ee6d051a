// The tables of docs/equality.md: how far many_lights is from `naive` with the same VPLs, settled,
// on every scene, from every camera and from outside, on both backends; its techniques `visibility`
// and `light_maps` at full resolution, and all that is on unless it is switched off.
//   lamplighter_equality [--pictures FOLDER] [PART_OF_A_SCENE'S_PATH...]
#include <algorithm>
#include <filesystem>
#include <iostream>

#include <spdlog/fmt/fmt.h>

#include "renderer/gl/headless_context.h"
#include "renderer/methods/common_parameters.h"
#include "renderer/methods/many_lights/parameters.h"
#include "renderer/scene/gltf_io.h"
#include "renderer/scene/render_scene.h"
#include "tests/equality/comparison.h"
#include "tests/support/shared_files.h"

namespace lamplighter::equality {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> kBackends = {"cpu", "gl"};
constexpr int kResolutions[] = {64, 256};

constexpr int kGroupedVpls = 800;  // from which on they are grouped

// What its size lets be done in a while.
int fewVpls(size_t triangles) { return triangles < 10000 ? 300 : 100; }
int defaultVpls(size_t) { return std::get<int>(parameters::vpls().defaultValue); }
int groupedVpls(size_t) { return kGroupedVpls; }

Column column(const std::string& backend, int resolution, const std::string& name, int vpls,
              const std::string& technique) {
  Column c{backend, resolution, name, naiveSettings(resolution, vpls)};
  c.settings.set(parameters::technique().name, technique);
  return c;
}

// Full resolution, and no groups.
std::vector<Column> shadowColumns(int vpls) {
  std::vector<Column> columns;
  for (const std::string& backend : kBackends)
    for (const int resolution : kResolutions)
      for (const std::string technique : {"visibility", "light_maps"}) {
        Column c = column(backend, resolution, technique, vpls, technique);
        c.settings.set(parameters::block().name, std::string("1"));
        c.settings.set(parameters::groupShare().name, 0.0f);
        columns.push_back(c);
      }
  return columns;
}

// With the low-resolution pass.
std::vector<Column> allColumns(int vpls) {
  std::vector<Column> columns;
  for (const std::string& backend : kBackends)
    for (const int resolution : kResolutions)
      columns.push_back(column(backend, resolution, "all", vpls, "light_maps"));
  return columns;
}

// With so many VPLs large maps take too long.
std::vector<Column> groupColumns(int vpls) {
  std::vector<Column> columns = allColumns(vpls);
  std::erase_if(columns, [](const Column& c) { return c.resolution != kResolutions[0]; });
  return columns;
}

// It is the cpu backend's, and looks up no maps.
std::vector<Column> transferColumns(int vpls) {
  Column c = column("cpu", kResolutions[0], "prt", vpls, "light_maps");
  c.settings.set(parameters::prt().name, true);
  return {c};
}

struct Kind {
  std::string title;
  double limit;
  int (*vpls)(size_t triangles);
  std::vector<Column> (*columns)(int vpls);
};

const Kind kKinds[] = {
    {"Visibility and light maps, at full resolution", 0.01, fewVpls, shadowColumns},
    {"All as it is by default", 0.03, defaultVpls, allColumns},
    {"All, with groups", 0.03, groupedVpls, groupColumns},
    {"All, with transfer", 0.03, defaultVpls, transferColumns}};

size_t trianglesOf(const Scene& scene) {
  RenderScene render;
  update(render, scene, SceneChanges::all());
  return render.indices.size() / 3;
}

void rule(size_t columns) {
  for (size_t i = 0; i < columns; ++i) std::cout << "| --- ";
  std::cout << "|\n";
}

// Those that are over the limit once more, with how far both are from what is right.
void printOver(const std::vector<Over>& over) {
  std::cout
      << "\n| scene | view | backend | maps | technique | from naive | naive from rays | from "
         "rays | database |\n";
  rule(9);
  for (const Over& o : over)
    std::cout << fmt::format(
        "| {} | {} | {} | {}² | {} | {:.2f}% | {:.2f}% | {:.2f}% | {:.3f}% |\n", o.scene, o.view,
        o.column.backend, o.column.resolution, o.column.name, 100 * o.error, 100 * o.naiveFromRays,
        100 * o.fromRays, 100 * o.database);
}

void print(const Kind& kind, const std::vector<fs::path>& scenes, const fs::path& folder) {
  const std::vector<Column> header = kind.columns(1);
  std::cout << "\n## " << kind.title << "\n\n| scene | view | VPLs |";
  for (const Column& c : header)
    std::cout << fmt::format(" {} {}² {} |", c.backend, c.resolution, c.name);
  std::cout << '\n';
  rule(3 + header.size());
  std::vector<Over> over;
  size_t all = 0;
  double most = 0.0;
  for (const fs::path& path : scenes) {
    const Scene scene = loadGltf(path).scene;
    const std::string name = path.stem().string();
    const int vpls = kind.vpls(trianglesOf(scene));
    const Compared compared = compare(name, scene, vpls, kind.columns(vpls), kind.limit, folder);
    for (const Row& row : compared.rows) {
      std::cout << fmt::format("| {} | {} | {} |", name, row.view, vpls);
      for (const double error : row.errors) {
        const char* mark = error < kind.limit ? "" : "**";
        std::cout << fmt::format(" {}{:.2f}%{} |", mark, 100 * error, mark);
        most = std::max(most, error);
        ++all;
      }
      std::cout << std::endl;  // it takes long: whoever looks on sees each
    }
    over.insert(over.end(), compared.over.begin(), compared.over.end());
  }
  std::cout << fmt::format(
      "\n{} of {} pictures are under {:.0f}%, the largest of all is {:.2f}%.\n", all - over.size(),
      all, 100 * kind.limit, 100 * most);
  if (!over.empty()) printOver(over);
}

int run(const std::vector<std::string>& arguments) {
  fs::path folder;
  std::vector<std::string> wanted;
  for (size_t i = 0; i < arguments.size(); ++i) {
    if (arguments[i] == "--pictures" && i + 1 < arguments.size()) {
      folder = arguments[++i];
      fs::create_directories(folder);
    } else {
      wanted.push_back(arguments[i]);
    }
  }
  std::vector<fs::path> scenes;
  for (const auto& entry :
       fs::directory_iterator(fs::path(LAMPLIGHTER_SOURCE_DIR) / "assets/scenes"))
    if (entry.path().extension() == ".gltf") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  for (const auto& row : test::readTable(test::sharedScenes() / "scenes.tsv"))
    scenes.push_back(test::sharedScenes() / row.at("file"));
  if (!wanted.empty())
    std::erase_if(scenes, [&](const fs::path& scene) {
      return std::ranges::none_of(wanted, [&](const std::string& part) {
        return scene.string().find(part) != std::string::npos;
      });
    });
  const gl::HeadlessContext context;
  for (const Kind& kind : kKinds) print(kind, scenes, folder);
  return 0;
}

}  // namespace
}  // namespace lamplighter::equality

int main(int argc, char** argv) {
  try {
    return lamplighter::equality::run({argv + 1, argv + argc});
  } catch (const std::exception& e) {
    std::cerr << "equality: " << e.what() << '\n';
    return 2;
  }
}
