// Draws light probes over the picture: balls with the light that falls on them.
#pragma once

#include <optional>

#include "editor/probes/live_probes.h"
#include "editor/tools/overlay.h"
#include "renderer/image/tone_map.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// How the picture below shows radiance.
struct ProbeLook {
  float exposureEv = 0.0f;
  ToneMapper toneMapper = ToneMapper::filmic;
};

// Of the ball at the pointer [unit of the scene].
float propRadius(const LiveProbes& probes);

// White Lambertian balls, one for each valid probe, with the brightness of the picture, and small
// red marks for others, which bakes fill in from neighbours. Those behind surfaces are left out.
// `prop`: the place of a larger ball with the light between probes. The view is in the unit of the
// scene, as are all places.
void drawProbes(Overlay& overlay, const View& view, const LiveProbes& probes,
                const RenderScene& scene, const RayCaster& rays, const ProbeLook& look,
                const std::optional<vec3>& prop);

}  // namespace lamplighter
