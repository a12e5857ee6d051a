// Finds the leaf patch of a point in the visibility database.
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
  // The highest patch above the leaf whose leaves all have the same lights.
  int wholeOf(uint32_t object, int leaf) const {
    return objects_[object][static_cast<size_t>(leaf)].whole;
  }
  // The depth of the leaf in its tree.
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
