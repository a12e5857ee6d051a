// Which pixels each light was summed at after a look-up in its shadow map: with that it is taken
// away again without another, and without its map as it was.
#pragma once

#include <cstdint>
#include <vector>

namespace lamplighter::cpu {

// A byte for each light and packet of a G-buffer, a bit for each lane. Row after row by slot, since
// packets that lie side by side are summed together.
class LitLanes {
 public:
  // Of more than so much nothing is kept.
  static constexpr size_t kMostBytes = size_t{32} << 20;

  // Makes room for this many slots at least. Returns whether all is as it was noted; else nothing
  // of it is known any more.
  bool fit(size_t slots, size_t packets) {
    if (packets == packets_ && slots <= slots_) return true;
    slots_ = (slots + kStep - 1) / kStep * kStep;
    packets_ = packets;
    lanes_.assign(slots_ * packets_ <= kMostBytes ? slots_ * packets_ : 0, 0);
    return false;
  }
  bool areKept() const { return !lanes_.empty(); }
  // By packet; null: none are kept.
  uint8_t* of(int slot) {
    if (slot < 0 || lanes_.empty()) return nullptr;
    return &lanes_[static_cast<size_t>(slot) * packets_];
  }
  size_t bytes() const { return lanes_.size(); }

 private:
  static constexpr size_t kStep = 64;

  size_t slots_ = 0, packets_ = 0;
  std::vector<uint8_t> lanes_;
};

}  // namespace lamplighter::cpu
