#include "renderer/backends/cpu/packet_block.h"

#include <algorithm>

namespace lamplighter::cpu {

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
  first_.push_back(first);
  if (g.isFlat[first / kLanes] != 0) {
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
}

}  // namespace lamplighter::cpu
