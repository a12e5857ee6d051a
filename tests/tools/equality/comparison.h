// How far pictures of many_lights are from `naive` with the same VPLs, and both from rays.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/scene/scene.h"

namespace lamplighter::equality {

// One way to make a picture, on one backend.
struct Column {
  std::string backend;  // "cpu" or "gl"
  int resolution;       // of shadow maps at rest
  std::string name;
  Settings settings;
};

// Settings of the technique `naive`: every VPL with its own shadow map at every pixel, whatever
// `block`, `group_share` and `prt` say. resolution: of maps at rest, texels a side; those before it
// are as by default where it is a multiple of them.
Settings naiveSettings(int resolution, int vpls);

struct Row {
  std::string view;
  std::vector<double> errors;  // relRMSE from naive, by column
};

// A picture that is over its limit.
struct Over {
  std::string scene, view;
  Column column;
  double error = 0.0;
  // With a ray for each shadow; and that itself with rays only where the technique looks maps up.
  double naiveFromRays = 0.0, fromRays = 0.0, database = 0.0;
};

struct Compared {
  std::vector<Row> rows;
  std::vector<Over> over;
};

// From every camera of the scene and from outside (`all of it`). Throws std::runtime_error where
// the VPLs are not those of naive, or where something has no room, so that another technique than
// that of the column is shown. `folder`, unless empty: where pictures over the limit go.
Compared compare(const std::string& name, const Scene& scene, int vpls,
                 const std::vector<Column>& columns, double limit,
                 const std::filesystem::path& folder);

}  // namespace lamplighter::equality
