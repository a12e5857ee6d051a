// Table of the partners of all texels in all directions, computed over several frames, direction by
// direction.
#pragma once

#include <vector>

#include "renderer/light_field/field_gather.h"

namespace lamplighter {

// Number of directions that are computed at a time.
inline constexpr size_t kDirectionsATime = 8;
// The order in which directions are computed: consecutive ones are far apart.
size_t spreadDirection(size_t place, size_t directions);
// Work in samples transported along lines. `triangles`: drawn triangles, counted once per
// direction.
uint64_t workOf(const PartnerCounts& counts, size_t triangles);

class PartnerTable {
 public:
  // Discards all partners.
  void restart(size_t receivers, size_t directions);
  // Marks all partners as outdated; the old ones are used until they are computed again.
  void outdate();
  // Continues by about `mostWork`; the unit is a sample transported along a line.
  PartnerCounts goOn(const FieldGeometry& geometry, uint64_t mostWork);
  // Whether all partners are up to date.
  bool isDone() const { return current_ == stamps_.size(); }
  // Whether all partners are known, possibly outdated ones.
  bool isFull() const { return known_ == stamps_.size(); }
  float shareKnown() const { return shareOf(known_); }
  float shareCurrent() const { return shareOf(current_); }

  // The known partners, by direction.
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
  uint32_t geometry_ = 1;            // current version of the geometry
  size_t known_ = 0, current_ = 0;   // directions
  size_t next_ = 0;                  // next direction, in the order of computation
  std::vector<LineRaster> rasters_;  // reused to avoid allocations
};

}  // namespace lamplighter
