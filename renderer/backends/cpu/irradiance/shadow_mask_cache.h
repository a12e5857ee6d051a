// Which pixels each light was summed at after a look-up in its shadow map: with that it is taken
// away again without another, and without its map as it was.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamplighter::cpu {

// Of one tile: a byte for each light and packet, a bit for each lane. What belongs to a light lies
// side by side, and only packets that are summed have any, so that what tiles that are summed
// together have of some lights stays in the caches.
class ShadowMaskCache {
 public:
  // Makes room for these packets (a bit each) and this many slots at least. What is noted of
  // packets that had room before stays.
  void keep(uint32_t packets, size_t slots);
  void forget() { *this = ShadowMaskCache(); }

  // The byte of a packet that there is room for and of slot 0; of each next slot: stride() on.
  uint8_t* of(int packet);
  size_t stride() const;
  size_t bytes() const { return lanes_.size(); }

 private:
  uint32_t packets_ = 0;
  std::vector<uint8_t> lanes_;  // by slot and packet
};

}  // namespace lamplighter::cpu
