#include "renderer/visibility/occlusion/light_packet.h"

#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

PyramidApex::PyramidApex(const shared::Vpl& vpl)
    : position(vpl.position),
      normal(vpl.normal),
      isParallel(vpl.position.w == shared::kVplDirectional) {
  if (!isParallel) rounding = rayEpsilon(position);
}

LightPacket::LightPacket(std::span<const PyramidApex* const> lights) : count(lights.size()) {
  for (size_t i = 0; i < kLights; ++i) {
    const PyramidApex& light = *lights[i < count ? i : 0];
    for (int c = 0; c < 3; ++c) {
      position[static_cast<size_t>(c)][i] = light.position[c];
      normal[static_cast<size_t>(c)][i] = light.normal[c];
    }
    rounding[i] = light.rounding;
  }
}

}  // namespace lamplighter
