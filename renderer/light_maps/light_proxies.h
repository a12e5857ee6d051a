// Light proxies: lights that replace others where these would need shadow map look-ups.
// - A VPL without a map (memory does not suffice, or it is not rendered yet) is replaced by a light
//   of the same brightness at the position of the nearest VPL with a map.
// - A group of VPLs close to each other is replaced by a light of their total brightness at the
//   position of one of them (Walter et al., Lightcuts, 2005). This applies to patches far from the
//   group that would need the maps of all its VPLs, and to glossy lobes that are wide compared with
//   the group, with or without maps. The proxy represents the area of all VPLs of the group, which
//   blurs its reflection.
//
// For the backends a proxy is a normal light: it has a slot, after those of the VPLs, and uses the
// map of the VPL at whose position it is.
#pragma once

#include <functional>
#include <map>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "renderer/light_maps/shadow_mode.h"
#include "renderer/sampling/light_sample_table.h"

namespace lamplighter {

class LightProxies {
 public:
  // Limits for groups.
  struct Groups {
    // largest share of the total light, directional light excluded, in one group; 0: no groups
    float share = 0.0f;
    // Whether two points see each other: VPLs on two sides of a wall form no group. Null: all do.
    std::function<bool(const vec3&, const vec3&)> sees;
    bool sceneChanged = false;  // the visibility between points may differ from the last call
  };
  // The lobes of the glossy pixels of a patch.
  struct Lobes {
    float alpha = 0.0f;  // lower bound of the squared roughness
  };
  // For the lights to sum.
  void update(const LightSampleTable& lights, const Groups& groups);

  size_t slots() const { return slots_ + room_; }  // of VPLs and proxies
  // The order depends only on what is shown.
  const std::vector<shared::Vpl>& lights() const { return lights_; }
  size_t groups() const { return groups_.size(); }
  // The slot whose map is used for the light in `slot`: itself or another.
  int mapSlot(int slot) const {
    const auto s = static_cast<size_t>(slot);
    return s < slots_ ? slot : mapSlots_[s - slots_];
  }
  bool isGroup(int slot) const {
    const auto s = static_cast<size_t>(slot);
    return s >= slots_ && isGroup_[s - slots_] != 0;
  }

  // Converts shadow modes: from those that the pixels of a patch would use if all VPLs had maps to
  // those for VPLs and proxies. `lobes`: null for irradiance; otherwise for these glossy lobes.
  // `only`: the slots of the VPLs that are summed; null: all.
  void apply(const vec3& centre, float radius, const Lobes* lobes, std::span<ShadowMode> bySlot,
             const std::vector<int>* only = nullptr) const;

 private:
  struct Group {
    int slot = 0;
    vec3 place{0.0f};
    float radius = 0.0f;  // all its VPLs are within this distance of its position [m]
    size_t first = 0, count = 0;
  };
  struct Numbers;
  void addSingleProxies(Numbers& numbers);
  void addGroupProxies(Numbers& numbers, const Groups& groups);
  void add(Numbers& numbers, uint64_t key, const shared::Vpl& at, const vec3& intensity,
           bool isGroup);

  // Copies of the table at the last update.
  std::vector<shared::Vpl> shown_;
  std::vector<uint8_t> hasMap_, needsMap_;  // by slot
  float groupShare_ = 0.0f;
  size_t slots_ = 0, room_ = 0;
  std::vector<shared::Vpl> lights_;
  // Index: the proxy's slot minus the number of VPL slots.
  std::vector<int> mapSlots_;
  std::vector<uint8_t> isGroup_;
  std::vector<int> proxy_;     // by slot of a VPL without a map
  std::vector<Group> groups_;  // large ones first
  std::vector<int> members_;   // slots
  // proxies of the last update; each keeps its slot while it exists
  std::map<uint64_t, int> numberOf_;
};

}  // namespace lamplighter
