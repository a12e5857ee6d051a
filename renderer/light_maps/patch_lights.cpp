#include "renderer/light_maps/patch_lights.h"

namespace lamplighter {

void PatchLights::uses(uint32_t object, int leaf, bool mapped, std::span<ShadowMode> bySlot) const {
  shadowModesOfAll(object, leaf, mapped, bySlot.first(visibility_.slots()));
  proxy(object, leaf, nullptr, bySlot);
}

void PatchLights::uses(uint32_t object, int leaf, const LightProxies::Lobes& lobes,
                       std::span<ShadowMode> bySlot) const {
  shadowModesOfAll(object, leaf, false, bySlot.first(visibility_.slots()));
  proxy(object, leaf, &lobes, bySlot);
}

void PatchLights::proxy(uint32_t object, int leaf, const LightProxies::Lobes* lobes,
                        std::span<ShadowMode> bySlot) const {
  if (lightProxies_ == nullptr) return;
  const Patch& patch = patches(object).patches[static_cast<size_t>(leaf)];
  lightProxies_->apply(patch.centre, patch.radius, lobes, bySlot, only_ ? &*only_ : nullptr);
}

// The modes if all lights had maps.
void PatchLights::shadowModesOfAll(uint32_t object, int leaf, bool mapped,
                                   std::span<ShadowMode> bySlot) const {
  static_assert(static_cast<int>(Occlusion::none) == 0 &&
                static_cast<int>(Occlusion::partial) == 1 &&
                static_cast<int>(Occlusion::full) == 2);
  constexpr ShadowMode kUses[2][3] = {
      {ShadowMode::add, ShadowMode::addShadowed, ShadowMode::skip},
      {ShadowMode::skip, ShadowMode::subtractShadow, ShadowMode::skip}};
  const auto states = visibility_.row(object, leaf);
  if (only_ && !mapped) {
    for (const int slot : *only_) {
      const auto i = static_cast<size_t>(slot);
      bySlot[i] = kUses[0][states[i]];
    }
    return;
  }
  if (!mapped) {
    for (size_t i = 0; i < bySlot.size(); ++i) bySlot[i] = kUses[0][states[i]];
    return;
  }
  if (hasTransfer(object, leaf)) {  // transfer includes shadows, so none are subtracted
    const auto held = prt_->held(object);
    for (size_t i = 0; i < bySlot.size(); ++i)
      bySlot[i] = held[i] != 0 ? ShadowMode::skip : kUses[0][states[i]];
    return;
  }
  const auto held = maps_->held(object, leaf);
  for (size_t i = 0; i < bySlot.size(); ++i) bySlot[i] = kUses[held[i] ? 1 : 0][states[i]];
}

}  // namespace lamplighter
