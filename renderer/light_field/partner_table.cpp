#include "renderer/light_field/partner_table.h"

#include <numeric>

namespace lamplighter {

size_t spreadDirection(size_t place, size_t directions) {
  if (directions < 3) return place;
  auto stride = static_cast<size_t>(0.6180339887 * static_cast<double>(directions));
  while (std::gcd(stride, directions) != 1) ++stride;
  return place * stride % directions;
}

uint64_t workOf(const PartnerCounts& counts, size_t triangles) {
  constexpr uint64_t kTriangles = 3, kRay = 24;  // triangles per unit of work; units per ray
  return counts.samples + counts.crossings + kRay * counts.rays + triangles / kTriangles;
}

void PartnerTable::restart(size_t receivers, size_t directions) {
  receivers_ = receivers;
  partners_.assign(receivers * directions, 0);
  stamps_.assign(directions, 0);
  geometry_ = 1;
  known_ = current_ = next_ = 0;
}

void PartnerTable::outdate() {
  ++geometry_;
  current_ = 0;
}

PartnerCounts PartnerTable::goOn(const FieldGeometry& geometry, uint64_t mostWork) {
  PartnerCounts counts;
  rasters_.resize(kDirectionsATime);
  for (uint64_t work = 0; !isDone() && work < mostWork;) {
    std::vector<PartnerTarget> found;
    while (found.size() < kDirectionsATime && current_ + found.size() < stamps_.size()) {
      const size_t direction = spreadDirection(next_, stamps_.size());
      next_ = (next_ + 1) % stamps_.size();
      if (stamps_[direction] != geometry_)
        found.push_back(
            {static_cast<uint32_t>(direction), partners_.data() + direction * receivers_});
    }
    const PartnerCounts foundNow = findPartners(geometry, found, rasters_);
    for (const PartnerTarget& r : found) {
      known_ += stamps_[r.direction] == 0 ? 1 : 0;
      stamps_[r.direction] = geometry_;
      ++current_;
    }
    const size_t drawn =
        geometry.sight == FieldSight::lines ? geometry.surface.triangles().size() : 0;
    work += workOf(foundNow, drawn * found.size());
    counts.add(foundNow);
  }
  return counts;
}

std::vector<PartnerRow> PartnerTable::rows() const {
  std::vector<PartnerRow> out;
  for (size_t d = 0; d < stamps_.size(); ++d)
    if (stamps_[d] != 0)
      out.push_back({static_cast<uint32_t>(d), partners_.data() + d * receivers_});
  return out;
}

}  // namespace lamplighter
