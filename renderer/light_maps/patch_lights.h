// The shadow mode of each light on each patch. It tells the backend what to sum where (paper 1,
// 4.3.4, "shadow subtraction"). It is derived from the visibility database and, if present, from
// light maps and precomputed radiance transfer (4.4).
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "renderer/light_maps/light_maps.h"
#include "renderer/light_maps/light_proxies.h"
#include "renderer/light_maps/shadow_mode.h"
#include "renderer/prt/prt_lights.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// Keeps references to these objects; they must outlive it and must not change
// during its lifetime.
class PatchLights {
 public:
  // maps: null if there are none; maps without memory count as none. mergesPasses: sum the lights
  // that need shadow maps in merged passes (pass_merging.h), if the backend sums in passes. prt:
  // null if there is none. lightProxies: which VPLs have maps, and the proxies of the others; null:
  // all have maps.
  PatchLights(const VisibilityDatabase& visibility, const LightMaps* maps,
              bool mergesPasses = false, const PrtLights* prt = nullptr,
              const LightProxies* lightProxies = nullptr)
      : visibility_(visibility),
        maps_(maps != nullptr && maps->texel() > 0.0f ? maps : nullptr),
        prt_(prt),
        lightProxies_(lightProxies),
        mergesPasses_(mergesPasses) {}

  // Only the lights in these slots, and their proxies, are summed: uses() does not change the modes
  // of other lights.
  void sumOnly(std::vector<int> slots) { only_ = std::move(slots); }

  const VisibilityDatabase& visibility() const { return visibility_; }
  const LightMaps* maps() const { return maps_; }
  const PrtLights* prt() const { return prt_; }
  bool mergesPasses() const { return mergesPasses_; }
  // Slots of the lights of the database and of the proxies.
  size_t slots() const { return lightProxies_ ? lightProxies_->slots() : visibility_.slots(); }
  // The slot whose shadow map is used for the light in `slot`.
  int mapSlot(int slot) const { return lightProxies_ ? lightProxies_->mapSlot(slot) : slot; }
  // Whether the light represents a group of VPLs.
  bool isGroup(int slot) const { return lightProxies_ && lightProxies_->isGroup(slot); }
  const ObjectPatches& patches(uint32_t object) const { return visibility_.patches(object); }

  // Whether pixels on the front of this leaf start from the light map. Pixels on its back, and on
  // leaves without a tile, sum all lights.
  bool isMapped(uint32_t object, int leaf) const {
    return maps_ != nullptr && maps_->tile(object, leaf) != nullptr;
  }
  // Whether pixels on the front of their triangle start from precomputed radiance transfer here.
  bool hasTransfer(uint32_t object, int leaf) const {
    return prt_ != nullptr && prt_->covers(patches(object), object, leaf);
  }
  // Writes slots() shadow modes by slot. `mapped`: for pixels that start from the light map or from
  // radiance transfer.
  void uses(uint32_t object, int leaf, bool mapped, std::span<ShadowMode> bySlot) const;
  // The same for the lobes of glossy pixels.
  void uses(uint32_t object, int leaf, const LightProxies::Lobes& lobes,
            std::span<ShadowMode> bySlot) const;

 private:
  void proxy(uint32_t object, int leaf, const LightProxies::Lobes* lobes,
             std::span<ShadowMode> bySlot) const;
  void shadowModesOfAll(uint32_t object, int leaf, bool mapped, std::span<ShadowMode> bySlot) const;

  const VisibilityDatabase& visibility_;
  const LightMaps* maps_;
  const PrtLights* prt_;
  const LightProxies* lightProxies_;
  bool mergesPasses_;
  std::optional<std::vector<int>> only_;
};

}  // namespace lamplighter
