#include "renderer/backends/cpu/many_lights/picture_light.h"

namespace lamplighter::cpu {

PacketIrradianceView PictureLight::at(int tile, int packet, PacketIrradiance& room) const {
  if (other != nullptr && (own[static_cast<size_t>(tile)] >> packet & 1) == 0)
    return other->at(tile, packet, room);
  if (isBetween(tile, packet)) {
    low->interpolate(tile, packet, room);
    return {room.r, room.g, room.b};
  }
  const size_t first =
      static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes;
  return {sums.red(first), sums.green(first), sums.blue(first)};
}

}  // namespace lamplighter::cpu
