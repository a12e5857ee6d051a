#include "renderer/backends/cpu/many_lights/share_sums.h"

#include <algorithm>
#include <cstring>

#include <tbb/parallel_for.h>

namespace lamplighter::cpu {

// Unless the last call left something open.
void ShareSums::begin(size_t group, bool isShifted) {
  if (open_ != Open::nothing) return;
  while (groups_.size() <= group) groups_.push_back(std::make_unique<Group>());
  isShifted_ = isShifted;
  last_ = groups_[group].get();
  sums().forgetMaps();  // they are those of another group
  own_ = {};
  open_ = Open::diffuse;
}

bool ShareSums::sumStill(size_t group, const PictureSums::Input& in, int block,
                         uint64_t mostLightPixels, SumCounts& counts) {
  begin(group, false);
  if (open_ != Open::diffuse) return true;
  counts = counts + still_.sum(in, block, false, mostLightPixels);
  if (still_.isLimited()) return false;
  Group& g = *groups_[group];
  g.sharing.take(in.gbuffer, still_.diffuse());
  keep(in.gbuffer, g);
  open_ = Open::speculars;
  return true;
}

bool ShareSums::sumShifted(size_t group, const PictureSums::Input& in, const GBuffer& still,
                           uint64_t mostLightPixels, SumCounts& counts) {
  begin(group, true);
  if (open_ != Open::diffuse) return true;
  own_ = groups_[group]->sharing.findOwn(still, in.gbuffer);
  const std::vector<uint32_t> some = shifted_.fitting(in, own_, mostLightPixels);
  counts = counts + shifted_.sumAt(in, some);
  if (!std::ranges::equal(some, own_)) return false;
  open_ = Open::speculars;
  return true;
}

bool ShareSums::sumSpeculars(const PictureSums::Input& in, float leastRoughness,
                             uint64_t mostLightPixels, SumCounts& counts) {
  counts.lightPixels += sums().sumSpeculars(in, leastRoughness, false, mostLightPixels);
  if (sums().speculars.isComplete()) open_ = Open::nothing;
  return open_ == Open::nothing;
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

std::vector<vec3> ShareSums::total(std::span<const vec3> weights) const {
  std::vector<vec3> e(groups_.empty() ? 0 : groups_.front()->r.size(), vec3(0.0f));
  tbb::parallel_for(tbb::blocked_range<size_t>(0, e.size()), [&](const auto& range) {
    for (size_t k = 0; k < std::min(groups_.size(), weights.size()); ++k) {
      const Group& g = *groups_[k];
      for (size_t i = range.begin(); i < range.end(); ++i)
        e[i] += weights[k] * vec3(g.r[i], g.g[i], g.b[i]);
    }
  });
  return e;
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
