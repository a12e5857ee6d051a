#include "renderer/light_maps/stand_ins.h"

#include <algorithm>
#include <limits>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// Slots are added in such steps, since a sum is made anew when their number changes.
constexpr size_t kStep = 64;

// How unlike two lights are as casters of shadows: the square of their distance and, as far as they
// look elsewhere, of what a metre away is [m²]. Lights of different kinds have nothing in common.
float unlikeness(const shared::Vpl& a, const shared::Vpl& b) {
  if (a.position.w != b.position.w) return std::numeric_limits<float>::max();
  const vec3 way = vec3(a.position) - vec3(b.position);
  const float turned = 1.0f - glm::dot(vec3(a.normal), vec3(b.normal));
  return glm::dot(way, way) + turned * turned;
}

}  // namespace

void StandIns::update(std::span<const shared::Vpl> shown, size_t slots,
                      const std::vector<uint8_t>& hasMap, const std::vector<uint8_t>& isWanted) {
  slots_ = slots;
  hasMap_ = hasMap;
  hasMap_.resize(slots, 0);
  standIn_.assign(slots, -1);
  std::vector<const shared::Vpl*> without, with;
  for (const shared::Vpl& vpl : shown) {
    const auto slot = static_cast<size_t>(vpl.intensity.w);
    if (hasMap_[slot] != 0)
      with.push_back(&vpl);
    else if (isWanted[slot] != 0)
      without.push_back(&vpl);
  }
  std::vector<const shared::Vpl*> nearest(without.size(), nullptr);
  tbb::parallel_for(size_t{0}, without.size(), [&](size_t i) {
    float least = std::numeric_limits<float>::max();
    for (const shared::Vpl* vpl : with) {
      const float d = unlikeness(*without[i], *vpl);
      if (d >= least) continue;
      least = d;
      nearest[i] = vpl;
    }
  });
  lights_.clear();
  mapSlots_.clear();
  for (size_t i = 0; i < without.size(); ++i) {
    if (nearest[i] == nullptr) continue;
    const size_t slot = slots_ + lights_.size();
    standIn_[static_cast<size_t>(without[i]->intensity.w)] = static_cast<int>(slot);
    mapSlots_.push_back(static_cast<int>(nearest[i]->intensity.w));
    shared::Vpl vpl = *nearest[i];
    vpl.intensity = vec4(vec3(without[i]->intensity), static_cast<float>(slot));
    lights_.push_back(vpl);
  }
  room_ = (lights_.size() + kStep - 1) / kStep * kStep;
}

}  // namespace lamplighter
