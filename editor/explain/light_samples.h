// The light samples that explain the light at a point, in the unit of the scene.
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
  float clampDistance = 0.0f;  // upper bound of 1/d² of samples: its value at this distance
  float unit = 1.0f;           // of the scene [m]
};

// The samples of the method, so that the explanation fits its picture. For a method without
// samples, such as the reference, it creates many samples with the method's number of bounces. If
// surfaces store bounced light or sky light, it adds samples for these.
LightSamples lightSamples(const Inspection& inspection, const RenderScene& scene,
                          const RayCaster& rays, const Settings& settings);

}  // namespace lamplighter
