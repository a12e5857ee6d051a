// The light samples by which the light at a point is told apart.
#pragma once

#include <vector>

#include "renderer/base/parameters.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

struct LightSamples {
  struct Sample {
    shared::Vpl vpl{};
    VplId id;
  };
  std::vector<Sample> samples;
  float clampDistance = 0.0f;  // 1/d² of samples is bounded by that of this distance [m]
};

// Those that the method shows, so that what is said is said of its picture. A method that has none,
// as the reference, is told of by many samples made for this, with as many bounces as it has.
LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings);

}  // namespace lamplighter
