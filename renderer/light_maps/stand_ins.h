// Lights that stand for others where these would have to look up shadow maps: for a VPL that has no
// map, because memory is short or its turn has not come, one at the nearest place that has.
//
// A stand-in is a light as any other for the backends: it has a slot, behind those of the VPLs, and
// looks up the map of the VPL at whose place it is.
#pragma once

#include <span>
#include <vector>

#include "renderer/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class StandIns {
 public:
  // `shown`: the VPLs, with their slots in intensity.w; by slot whether it has a map, and whether
  // the view wants it to have one.
  void update(std::span<const shared::Vpl> shown, size_t slots, const std::vector<uint8_t>& hasMap,
              const std::vector<uint8_t>& isWanted);

  size_t slots() const { return slots_ + room_; }  // of VPLs and stand-ins
  const std::vector<shared::Vpl>& lights() const { return lights_; }
  // Whose map the light in a slot looks up, its own or another's.
  int mapSlot(int slot) const {
    const auto s = static_cast<size_t>(slot);
    return s < slots_ ? slot : mapSlots_[s - slots_];
  }
  bool hasMap(size_t slot) const { return hasMap_[slot] != 0; }
  // The slot of what stands for a VPL without a map; −1: nothing does.
  int standInOf(size_t slot) const { return standIn_[slot]; }

 private:
  size_t slots_ = 0, room_ = 0;
  std::vector<shared::Vpl> lights_;
  std::vector<int> mapSlots_;    // by stand-in
  std::vector<int> standIn_;     // by slot
  std::vector<uint8_t> hasMap_;  // by slot
};

}  // namespace lamplighter
