// How the pixels of each patch come by each light: what a backend is told to sum where (paper 1,
// 4.3.4, "shadow subtraction"). Made of the visibility database and, if there are any, light maps
// and light by precomputed transfer (4.4).
#pragma once

#include <span>

#include "renderer/light_maps/light_maps.h"
#include "renderer/light_maps/light_proxies.h"
#include "renderer/light_maps/shadow_mode.h"
#include "renderer/prt/prt_lights.h"
#include "renderer/visibility/visibility_database.h"

namespace lamplighter {

// Views into these, which must outlive it and stay as they are.
class PatchLights {
 public:
  // maps: null when there are none; those that have no room are none. mergesPasses: lights that
  // need their shadow maps are to be summed by merged passes (pass_merging.h), where the backend
  // sums by passes at all. prt: null where there is none, and for backends that do not take it
  // (BackendInfo::takesTransfer). lightProxies: which VPLs have maps, and what stands for those
  // that have none; null: all have.
  PatchLights(const VisibilityDatabase& visibility, const LightMaps* maps,
              bool mergesPasses = false, const PrtLights* prt = nullptr,
              const LightProxies* lightProxies = nullptr)
      : visibility_(visibility),
        maps_(maps != nullptr && maps->texel() > 0.0f ? maps : nullptr),
        prt_(prt),
        lightProxies_(lightProxies),
        mergesPasses_(mergesPasses) {}

  const VisibilityDatabase& visibility() const { return visibility_; }
  const LightMaps* maps() const { return maps_; }
  const PrtLights* prt() const { return prt_; }
  bool mergesPasses() const { return mergesPasses_; }
  // Of the database's lights and of what stands for some of them.
  size_t slots() const { return lightProxies_ ? lightProxies_->slots() : visibility_.slots(); }
  // Whose shadow map the light in a slot looks up.
  int mapSlot(int slot) const { return lightProxies_ ? lightProxies_->mapSlot(slot) : slot; }
  // Whether it stands for several.
  bool isGroup(int slot) const { return lightProxies_ && lightProxies_->isGroup(slot); }
  const ObjectPatches& patches(uint32_t object) const { return visibility_.patches(object); }

  // Whether pixels on the front of this leaf begin with what the light map says. Its back, and what
  // has no tile, sums all lights itself.
  bool isMapped(uint32_t object, int leaf) const {
    return maps_ != nullptr && maps_->tile(object, leaf) != nullptr;
  }
  // Whether pixels on the front of their triangle begin with light by precomputed transfer here.
  bool hasTransfer(uint32_t object, int leaf) const {
    return prt_ != nullptr && prt_->covers(patches(object), object, leaf);
  }
  // By slot, slots() of them. `mapped`: for pixels that begin with the light map, or with light by
  // transfer.
  void uses(uint32_t object, int leaf, bool mapped, std::span<ShadowMode> bySlot) const;
  // The same for lobes of glossy pixels.
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
};

}  // namespace lamplighter
