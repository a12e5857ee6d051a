// Lights that stand for others where these would have to look up shadow maps:
// - for a VPL that has no map, because memory is short or its turn has not come, one as bright at
//   the place of the nearest that has;
// - for a group of VPLs near each other, one as bright as all of them at the place of one of them
//   (Walter et al., Lightcuts, 2005), for patches that are far from the group and on which all its
//   VPLs would look their maps up; and for lobes that are wide beside it, with maps or without. It
//   stands for the area of all of them, which blurs what a lobe shows of it.
//
// A stand-in is a light as any other for the backends: it has a slot, behind those of the VPLs, and
// looks up the map of the VPL at whose place it is.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/light_maps/shadow_mode.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

class LightProxies {
 public:
  // What a group may be.
  struct Groups {
    float share = 0.0f;  // of all light but parallel light, what one has at most; 0: there is none
    // Whether one place sees another: what is on two sides of a wall is no group. Null: they all
    // do.
    std::function<bool(const vec3&, const vec3&)> sees;
    bool sceneChanged = false;  // places may see others than in the last call
  };
  // Of glossy pixels of a patch.
  struct Lobes {
    float alpha = 0.0f;  // the square of the roughness, at least
  };
  // `shown`: the VPLs, with their slots in intensity.w; by slot whether it has a map, and whether
  // the view wants it to have one.
  void update(std::span<const shared::Vpl> shown, size_t slots, const std::vector<uint8_t>& hasMap,
              const std::vector<uint8_t>& isWanted, const Groups& groups);

  size_t slots() const { return slots_ + room_; }  // of VPLs and stand-ins
  // In an order that follows from what is shown.
  const std::vector<shared::Vpl>& lights() const { return lights_; }
  size_t groups() const { return groups_.size(); }
  // Whose map the light in a slot looks up, its own or another's.
  int mapSlot(int slot) const {
    const auto s = static_cast<size_t>(slot);
    return s < slots_ ? slot : mapSlots_[s - slots_];
  }
  bool isGroup(int slot) const {
    const auto s = static_cast<size_t>(slot);
    return s >= slots_ && isGroup_[s - slots_] != 0;
  }

  // Makes of how the pixels of a patch would use each VPL, if all had maps, how they use VPLs and
  // stand-ins. `lobes`: null: for irradiance; else for these.
  void apply(const vec3& centre, float radius, const Lobes* lobes,
             std::span<ShadowMode> bySlot) const;

 private:
  struct Group {
    int slot = 0;
    vec3 place{0.0f};
    float radius = 0.0f;  // all of its VPLs are within it of the place [m]
    size_t first = 0, count = 0;
  };
  struct Numbers;
  void addSingleProxies(Numbers& numbers);
  void addGroupProxies(Numbers& numbers, const Groups& groups);
  void add(Numbers& numbers, uint64_t key, const shared::Vpl& at, const vec3& intensity,
           bool isGroup);

  std::vector<shared::Vpl> shown_;
  std::vector<uint8_t> hasMap_, isWanted_;  // by slot
  float groupShare_ = 0.0f;
  size_t slots_ = 0, room_ = 0;
  std::vector<shared::Vpl> lights_;
  // By stand-in's slot behind the VPLs'.
  std::vector<int> mapSlots_;
  std::vector<uint8_t> isGroup_;
  std::vector<int> proxy_;            // by slot of a VPL without a map
  std::vector<Group> groups_;         // large ones first
  std::vector<int> members_;          // slots
  std::map<uint64_t, int> numberOf_;  // of what there was last: it keeps its slot while it is there
};

}  // namespace lamplighter
