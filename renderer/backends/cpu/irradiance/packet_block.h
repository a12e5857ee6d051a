// Packets of a G-buffer that are summed together, and their sums meanwhile, side by side in memory.
// In the G-buffer what belongs to a packet lies in nine arrays, whose beginnings fall into the same
// sets of the first-level cache: packets here and there would drive each other out of it for each
// light anew.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/backends/cpu/gbuffer/gbuffer.h"

namespace lamplighter::cpu {

// E of each pixel in units, structure of arrays over the whole G-buffer.
struct FixedSums {
  std::vector<int32_t> r, g, b;
};

class PacketBlock {
 public:
  // Few enough that they fit the first-level cache beside a shadow map; and several tiles', so that
  // making a light ready is worth it where few of a tile are meant.
  static constexpr size_t kMost = 96;
  static_assert(kMost <= 256);  // numbers of packets and planes are bytes

  // By coordinate or channel and lane.
  struct alignas(32) Packet {
    float position[3][kLanes];  // [m]
    float shading[3][kLanes];   // normals
    int32_t sum[3][kLanes];     // what was added here
  };

  PacketBlock() { packets_.reserve(kMost); }
  size_t count() const { return packets_.size(); }
  // The packet of the G-buffer whose first pixel this is.
  void add(const GBuffer& gbuffer, size_t first);
  size_t first(size_t k) const { return first_[k]; }
  const Packet& at(size_t k) const { return packets_[k]; }
  Packet& at(size_t k) { return packets_[k]; }
  // Geometric normals of a packet that is not flat, by coordinate and lane; else null.
  const float* geometric(size_t k) const {
    return geometric_[k] == kFlat ? nullptr : &normals_[geometric_[k]];
  }
  // The same of packets one after another whose normals are the same and that are flat.
  uint8_t plane(size_t k) const { return plane_[k]; }
  // Adds what was summed to the sums of the G-buffer. Once.
  void addTo(FixedSums& sums) const;

 private:
  static constexpr uint32_t kFlat = ~uint32_t{0};

  std::vector<Packet> packets_;
  std::vector<size_t> first_;
  std::vector<uint32_t> geometric_;  // where in normals_
  std::vector<uint8_t> plane_;
  std::vector<float> normals_;
};

}  // namespace lamplighter::cpu
