#include "renderer/light_maps/patch_lights.h"

#include <algorithm>

namespace lamplighter {

void PatchLights::uses(uint32_t object, int leaf, bool mapped, std::span<LightUse> bySlot) const {
  const size_t slots = visibility_.slots();
  usesOfAll(object, leaf, mapped, bySlot.first(slots));
  if (standIns_ == nullptr) return;
  std::fill(bySlot.begin() + static_cast<ptrdiff_t>(slots), bySlot.end(), LightUse::skip);
  for (size_t i = 0; i < slots; ++i) {
    if (standIns_->hasMap(i) || bySlot[i] == LightUse::skip || bySlot[i] == LightUse::add) continue;
    const int standIn = standIns_->standInOf(i);
    if (standIn >= 0) bySlot[static_cast<size_t>(standIn)] = bySlot[i];
    bySlot[i] = LightUse::skip;
  }
}

// As if all had their maps.
void PatchLights::usesOfAll(uint32_t object, int leaf, bool mapped,
                            std::span<LightUse> bySlot) const {
  static_assert(static_cast<int>(Occlusion::none) == 0 &&
                static_cast<int>(Occlusion::partial) == 1 &&
                static_cast<int>(Occlusion::full) == 2);
  constexpr LightUse kUses[2][3] = {{LightUse::add, LightUse::addShadowed, LightUse::skip},
                                    {LightUse::skip, LightUse::takeShadow, LightUse::skip}};
  const auto states = visibility_.row(object, leaf);
  if (!mapped) {
    for (size_t i = 0; i < bySlot.size(); ++i) bySlot[i] = kUses[0][states[i]];
    return;
  }
  if (hasTransfer(object, leaf)) {  // with shadows, so that none are to be taken away
    const auto held = prt_->held(object);
    for (size_t i = 0; i < bySlot.size(); ++i)
      bySlot[i] = held[i] != 0 ? LightUse::skip : kUses[0][states[i]];
    return;
  }
  const auto held = maps_->held(object, leaf);
  for (size_t i = 0; i < bySlot.size(); ++i) bySlot[i] = kUses[held[i]][states[i]];
}

}  // namespace lamplighter
