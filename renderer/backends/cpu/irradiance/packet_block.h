// Packets of a G-buffer that are summed together, copied with their sums into contiguous memory. In
// the G-buffer the data of a packet lie in nine arrays whose starts map to the same sets of the L1
// cache, so scattered packets would evict each other for every light.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter::cpu {

// E of each pixel in fixed-point units; structure of arrays over the whole G-buffer.
struct FixedSums {
  // Fine steps per unit. The sum of the rounding errors of 2¹⁷ lights fits into 32 bits.
  static constexpr float kFinePerUnit = 0x1p14f;

  std::vector<int32_t> r, g, b;
  // Sums of rounding errors, in units / kFinePerUnit. Empty if they are not summed.
  std::vector<int32_t> fineR, fineG, fineB;
};

class PacketBlock {
 public:
  // Small enough to fit into the L1 cache beside a shadow map. Large enough for packets of several
  // tiles, so that preparing a light pays off even if few packets of a tile are selected.
  static constexpr size_t kMost = 96;
  static_assert(kMost <= 256);  // indices of packets and planes are bytes

  // By coordinate or channel, then lane.
  struct alignas(32) Packet {
    float position[3][kLanes];  // [m]
    float shading[3][kLanes];   // shading normals
    int32_t sum[3][kLanes];     // added since the packet joined the block
  };

  PacketBlock() { packets_.reserve(kMost); }
  size_t count() const { return packets_.size(); }
  // Adds the packet of the G-buffer whose first pixel is `first`.
  void add(const GBuffer& gbuffer, size_t first);
  size_t first(size_t k) const { return first_[k]; }
  const Packet& at(size_t k) const { return packets_[k]; }
  Packet& at(size_t k) { return packets_[k]; }
  // The second part of the sums of a packet, by channel, then lane. Only after sumFinely().
  using Fine = int32_t[3][kLanes];
  Fine& fine(size_t k) { return fine_[k].sum; }
  // Call before the first packet is added: sums have a second part.
  void sumFinely() { isFine_ = true; }
  // Geometric normals by coordinate and lane, if the packet is not flat; otherwise null.
  const float* geometric(size_t k) const {
    return geometric_[k] == kFlat ? nullptr : &normals_[geometric_[k]];
  }
  // Equal for consecutive flat packets with the same normals.
  uint8_t plane(size_t k) const { return plane_[k]; }
  // Adds the sums of the block to the sums of the G-buffer. Call once.
  void addTo(FixedSums& sums) const;

 private:
  static constexpr uint32_t kFlat = ~uint32_t{0};

  struct alignas(32) FinePacket {
    int32_t sum[3][kLanes];
  };

  bool isFine_ = false;
  std::vector<Packet> packets_;
  std::vector<FinePacket> fine_;  // by packet; empty if sums have one part
  std::vector<size_t> first_;
  std::vector<uint32_t> geometric_;  // index into normals_
  std::vector<uint8_t> plane_;
  std::vector<float> normals_;
};

}  // namespace lamplighter::cpu
