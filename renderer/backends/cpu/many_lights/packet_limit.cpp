#include "renderer/backends/cpu/many_lights/packet_limit.h"

#include <algorithm>

namespace lamplighter::cpu {
namespace {

// The tiles of a sun light only a part of the scene each; elsewhere they cost the test for it.
constexpr float kLeastCost = 0.25f;

}  // namespace

PacketLimit::PacketLimit(const GBuffer& gbuffer, const IrradianceAccumulator& sums,
                         std::span<const LightRecord> lights, uint64_t mostLightPixels)
    : gbuffer_(gbuffer), sums_(sums), left_(mostLightPixels) {
  float everywhere = 0.0f;
  for (const LightRecord& light : lights) {
    const float side = std::min(light.side / std::max(light.radius, 1e-6f), 1.0f);
    everywhere +=
        light.kind == LightRecord::Kind::directional ? std::max(side * side, kLeastCost) : 1.0f;
  }
  all_ = static_cast<uint64_t>(everywhere) + 1;
  changes_ = lights.empty() ? 0 : sums.changesTo(lights) * all_ / lights.size();
}

uint32_t PacketLimit::goOn(size_t tile, uint32_t packets) {
  packets &= sums_.summed(gbuffer_, tile);
  const uint64_t needed = cost(packets, changes_);
  if (needed > left_) packets = 0;
  left_ = needed > left_ ? 0 : left_ - needed;
  return packets;
}

uint32_t PacketLimit::begin(size_t tile, uint32_t packets) {
  packets &= ~sums_.summed(gbuffer_, tile);
  const uint64_t needed = cost(packets, all_);
  if (needed > left_ && hasBegun_) packets = 0;
  left_ = needed > left_ ? 0 : left_ - needed;
  hasBegun_ = hasBegun_ || packets != 0;
  return packets;
}

}  // namespace lamplighter::cpu
