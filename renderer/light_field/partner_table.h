// The partners of all texels in all directions, kept: found over several frames, direction by
// direction.
#pragma once

#include <vector>

#include "renderer/light_field/field_gather.h"

namespace lamplighter {

// How many directions are found at a time.
inline constexpr size_t kDirectionsATime = 8;
// The order in which directions are found: consecutive ones are far from each other.
size_t spreadDirection(size_t place, size_t directions);
// In samples transported along lines. `triangles`: drawn, counted once for each direction.
uint64_t workOf(const PartnerCounts& counts, size_t triangles);

class PartnerTable {
 public:
  // Forgets everything.
  void restart(size_t receivers, size_t directions);
  // All partners are to be found again; until then the old ones stay.
  void outdate();
  // Goes on by about so much work; its unit is a sample transported along a line.
  PartnerCounts goOn(const FieldGeometry& geometry, uint64_t mostWork);
  // Whether all partners are those of now.
  bool isDone() const { return current_ == stamps_.size(); }
  // Whether all are found, maybe of before.
  bool isFull() const { return known_ == stamps_.size(); }
  float shareKnown() const { return shareOf(known_); }
  float shareCurrent() const { return shareOf(current_); }

  // Those that are found, by direction.
  std::vector<PartnerRow> rows() const;

  size_t bytes() const { return partners_.size() * sizeof(uint32_t); }

 private:
  float shareOf(size_t directions) const {
    return stamps_.empty() ? 1.0f
                           : static_cast<float>(directions) / static_cast<float>(stamps_.size());
  }
  size_t receivers_ = 0;
  std::vector<uint32_t> partners_;   // by direction, then by receiver
  std::vector<uint32_t> stamps_;     // by direction: the geometry of its partners; 0: none
  uint32_t geometry_ = 1;            // of now
  size_t known_ = 0, current_ = 0;   // directions
  size_t next_ = 0;                  // where to go on, in the order of finding
  std::vector<LineRaster> rasters_;  // kept for their memory
};

}  // namespace lamplighter
