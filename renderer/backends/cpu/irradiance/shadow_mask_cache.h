// Records the pixels where each light was added after a shadow map look-up. With this mask the
// light can be subtracted without a second look-up and without its old map.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lamplighter::cpu {

// For one tile: one byte per light and packet, one bit per lane. The bytes of one light are
// contiguous, and only packets that are summed have bytes, so that the data of a few lights over
// several tiles stay in the CPU caches.
class ShadowMaskCache {
 public:
  // Makes room for these packets (one bit each) and for at least this number of slots. Masks of
  // packets that had room before are kept.
  void keep(uint32_t packets, size_t slots);
  void forget() { *this = ShadowMaskCache(); }

  // The byte of slot 0 of a packet that has room; the bytes of the next slots follow at steps of
  // stride().
  uint8_t* of(int packet);
  size_t stride() const;
  size_t bytes() const { return lanes_.size(); }

 private:
  uint32_t packets_ = 0;
  std::vector<uint8_t> lanes_;  // by slot, then packet
};

}  // namespace lamplighter::cpu
