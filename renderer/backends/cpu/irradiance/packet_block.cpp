#include "renderer/backends/cpu/irradiance/packet_block.h"

#include <algorithm>

namespace lamplighter::cpu {
namespace {

bool haveSameNormals(const PacketBlock::Packet& a, const PacketBlock::Packet& b) {
  for (size_t axis = 0; axis < 3; ++axis)
    if (!std::ranges::equal(a.shading[axis], b.shading[axis])) return false;
  return true;
}

}  // namespace

void PacketBlock::add(const GBuffer& g, size_t first) {
  Packet& p = packets_.emplace_back();
  const auto copy = [&](const std::vector<float>& from, float* to) {
    std::copy_n(&from[first], kLanes, to);
  };
  copy(g.px, p.position[0]);
  copy(g.py, p.position[1]);
  copy(g.pz, p.position[2]);
  copy(g.sx, p.shading[0]);
  copy(g.sy, p.shading[1]);
  copy(g.sz, p.shading[2]);
  for (auto& channel : p.sum) std::fill_n(channel, kLanes, 0);
  if (isFine_) fine_.push_back({});
  first_.push_back(first);
  const size_t k = packets_.size() - 1;
  const bool isFlat = g.isFlat[first / kLanes] != 0;
  const bool goesOn = k > 0 && isFlat && geometric_.back() == kFlat &&
                      haveSameNormals(packets_[k - 1], packets_[k]);
  plane_.push_back(goesOn ? plane_.back() : static_cast<uint8_t>(k));
  if (isFlat) {
    geometric_.push_back(kFlat);
    return;
  }
  geometric_.push_back(static_cast<uint32_t>(normals_.size()));
  normals_.resize(normals_.size() + size_t{3} * kLanes);
  float* normals = &normals_[geometric_.back()];
  copy(g.gx, normals);
  copy(g.gy, normals + kLanes);
  copy(g.gz, normals + size_t{2} * kLanes);
}

void PacketBlock::addTo(FixedSums& sums) const {
  std::vector<int32_t>* const channels[] = {&sums.r, &sums.g, &sums.b};
  for (size_t k = 0; k < packets_.size(); ++k)
    for (int c = 0; c < 3; ++c)
      for (size_t lane = 0; lane < kLanes; ++lane)
        (*channels[c])[first_[k] + lane] += packets_[k].sum[c][lane];
  std::vector<int32_t>* const fine[] = {&sums.fineR, &sums.fineG, &sums.fineB};
  for (size_t k = 0; k < fine_.size(); ++k)
    for (int c = 0; c < 3; ++c)
      for (size_t lane = 0; lane < kLanes; ++lane)
        (*fine[c])[first_[k] + lane] += fine_[k].sum[c][lane];
}

}  // namespace lamplighter::cpu
