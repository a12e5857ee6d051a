#include "renderer/backends/cpu/many_lights/share_sums.h"

#include <cstring>

#include <tbb/parallel_for.h>

namespace lamplighter::cpu {

SumCounts ShareSums::sumStill(size_t group, const PictureSums::Input& in, int block) {
  while (groups_.size() <= group) groups_.push_back(std::make_unique<Group>());
  Group& g = *groups_[group];
  isShifted_ = false;
  still_.forgetMaps();  // they are those of another group
  const SumCounts counts = still_.sum(in, block, false);
  g.sharing.take(in.gbuffer, still_.diffuse());
  keep(in.gbuffer, g);
  last_ = &g;
  own_ = {};
  return counts;
}

SumCounts ShareSums::sumShifted(size_t group, const PictureSums::Input& in, const GBuffer& still) {
  Group& g = *groups_[group];
  isShifted_ = true;
  shifted_.forgetMaps();
  own_ = g.sharing.findOwn(still, in.gbuffer);
  last_ = &g;
  return shifted_.sumAt(in, own_);
}

uint64_t ShareSums::sumSpeculars(const PictureSums::Input& in, float leastRoughness) {
  sums().speculars.forgetMaps();
  return sums().sumSpeculars(in, leastRoughness, false);
}

void ShareSums::keep(const GBuffer& gbuffer, Group& group) const {
  const size_t pixels = gbuffer.px.size();
  for (auto* v : {&group.r, &group.g, &group.b}) v->resize(pixels);
  const PictureLight light = still_.diffuse();
  tbb::parallel_for(0, gbuffer.tiles(), [&](int tile) {
    for (int packet = 0; packet < kPacketsPerTile; ++packet) {
      const size_t first =
          static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes;
      PacketIrradiance room;
      const PacketIrradianceView e = light.at(tile, packet, room);
      std::memcpy(&group.r[first], e.r, sizeof(float) * kLanes);
      std::memcpy(&group.g[first], e.g, sizeof(float) * kLanes);
      std::memcpy(&group.b[first], e.b, sizeof(float) * kLanes);
    }
  });
}

PacketIrradianceView ShareSums::at(int tile, int packet) const {
  const size_t first =
      static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes;
  if (!own_.empty() && (own_[static_cast<size_t>(tile)] >> packet & 1) != 0)
    return {shifted_.sums.red(first), shifted_.sums.green(first), shifted_.sums.blue(first)};
  return {&last_->r[first], &last_->g[first], &last_->b[first]};
}

size_t ShareSums::bytes() const {
  size_t bytes = still_.bytes() + shifted_.bytes();
  for (const auto& group : groups_) bytes += 3 * sizeof(float) * group->r.size();
  return bytes;
}

}  // namespace lamplighter::cpu
