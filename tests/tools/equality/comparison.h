// Compares pictures of many_lights with `naive` for the same VPLs, and both with ray-traced
// shadows.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/scene/scene.h"

namespace lamplighter::equality {

// One column of the table: a technique on a backend.
struct Column {
  std::string backend;  // "cpu" or "gl"
  int resolution;       // resolution of shadow maps at rest
  std::string name;
  Settings settings;
};

// Settings of the technique `naive`: every VPL has its own shadow map and lights every pixel,
// independent of `block`, `group_share` and `prt`. `resolution`: side of the maps at rest [texels].
// Previous resolutions keep their defaults if `resolution` is a multiple of them.
Settings naiveSettings(int resolution, int vpls);

struct Row {
  std::string view;
  std::vector<double> errors;  // relRMSE from naive, by column
};

// A picture whose error is above its limit.
struct Over {
  std::string scene, view;
  Column column;
  double error = 0.0;
  // Errors relative to ray-traced shadows: with a ray for each shadow, and (`database`) with rays
  // only where the technique looks up shadow maps.
  double naiveFromRays = 0.0, fromRays = 0.0, database = 0.0;
};

struct Compared {
  std::vector<Row> rows;
  std::vector<Over> over;
};

// Compares from every camera of the scene and from a view of the whole scene (`all of it`). Throws
// std::runtime_error if the VPLs differ from those of naive, or if memory is short and a technique
// other than the column's is used. `folder`: for pictures above the limit; empty: none are written.
Compared compare(const std::string& name, const Scene& scene, int vpls,
                 const std::vector<Column>& columns, double limit,
                 const std::filesystem::path& folder);

}  // namespace lamplighter::equality
