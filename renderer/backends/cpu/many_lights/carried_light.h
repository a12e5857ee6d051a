// Irradiance that pixels reuse from the previous picture while the camera moves, because diffuse
// light does not depend on the view. It is that of the nearest old pixel, so the caller must sum
// each pixel again from time to time: otherwise small displacements would add up.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/backends/cpu/composition.h"
#include "renderer/backends/cpu/gbuffer/gbuffer.h"
#include "renderer/backends/cpu/gbuffer/seen_points.h"

namespace lamplighter::cpu {

struct PictureLight;

class CarriedLight {
 public:
  // Stores the light of a picture. open: by tile, the packets that `light` does not know, one bit
  // each, where the picture has what it took over itself.
  void take(const PictureLight& light, std::span<const uint32_t> open);
  // The light of all pixels of the present picture is known, in the order of its G-buffer.
  void know(std::vector<vec3> e);
  // Looks up the pixels of these packets (by tile, one bit each) of the next picture. `before`: the
  // points of the stored one.
  void find(const GBuffer& gbuffer, const SeenPoints& before, std::span<const uint32_t> packets);
  void forget() { *this = CarriedLight(); }

  // Whether there is light for a picture of `tiles` tiles.
  bool isOf(int tiles) const { return whole_.size() == static_cast<size_t>(tiles); }
  // The packets of a tile of which all pixels were found, one bit each. Misses count as found.
  uint32_t whole(size_t tile) const { return whole_[tile]; }
  // The lanes of a packet that were found, one bit each.
  uint8_t lanes(int tile, int packet) const {
    return now_.lanes[static_cast<size_t>(tile) * kPacketsPerTile + static_cast<size_t>(packet)];
  }
  // Writes their E.
  void read(int tile, int packet, PacketIrradiance& out) const;

  size_t bytes() const;

 private:
  struct Light {
    std::vector<vec3> e;         // by pixel, in the order of the G-buffer
    std::vector<uint8_t> lanes;  // by packet: where e is known, one bit each
  };
  Light last_, now_;
  std::vector<uint32_t> whole_;
};

}  // namespace lamplighter::cpu
