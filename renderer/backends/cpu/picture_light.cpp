#include "renderer/backends/cpu/picture_light.h"

#include <algorithm>

namespace lamplighter::cpu {

void PictureLight::at(int tile, int packet, Irradiance& out) const {
  if (other != nullptr && (own[static_cast<size_t>(tile)] >> packet & 1) == 0)
    return other->at(tile, packet, out);
  if (isBetween(tile, packet)) return low->interpolate(tile, packet, out);
  const size_t first =
      static_cast<size_t>(tile) * kTilePixels + static_cast<size_t>(packet) * kLanes;
  std::copy_n(sums.red(first), kLanes, out.r);
  std::copy_n(sums.green(first), kLanes, out.g);
  std::copy_n(sums.blue(first), kLanes, out.b);
}

}  // namespace lamplighter::cpu
