// Which patch a point lies in, as far as the visibility database divides them.
#pragma once

#include <vector>

#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

class PatchLookup {
 public:
  explicit PatchLookup(const VisibilityDatabase& visibility);

  int leafAt(uint32_t object, uint32_t triangle, const vec3& position) const {
    return visibility_.patches(object).leafAt(triangle, position);
  }
  // The patch above the leaf that is looked at as one; all leaves under it have the same lights.
  int wholeOf(uint32_t object, int leaf) const {
    return objects_[object][static_cast<size_t>(leaf)].whole;
  }
  // How often its root was halved to get it.
  int levelOf(uint32_t object, int leaf) const {
    return objects_[object][static_cast<size_t>(leaf)].level;
  }
  bool isPlanar(uint32_t object, int leaf) const {
    return visibility_.patches(object).patches[static_cast<size_t>(leaf)].chart != kNone;
  }

 private:
  struct Place {
    int whole = kNone;
    int level = 0;
  };
  const VisibilityDatabase& visibility_;
  std::vector<std::vector<Place>> objects_;  // by patch
};

}  // namespace lamplighter
