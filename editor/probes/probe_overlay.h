// Draws light probes over the picture: balls that are lit by the probes.
#pragma once

#include <optional>

#include "editor/probes/live_probes.h"
#include "editor/tools/overlay.h"
#include "renderer/image/tone_map.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// Exposure and tone mapping of the picture below.
struct ProbeLook {
  float exposureEv = 0.0f;
  ToneMapper toneMapper = ToneMapper::filmic;
};

// Radius of the ball at the pointer [unit of the scene].
float propRadius(const LiveProbes& probes);

// White Lambertian balls, one for each valid probe, with the brightness of the picture, and small
// red marks for invalid probes, which bakes fill in from neighbours. Balls behind surfaces are not
// drawn. `prop`: the place of a larger ball with the light between probes. The view is in the unit
// of the scene, as are all places.
void drawProbes(Overlay& overlay, const View& view, const LiveProbes& probes,
                const RenderScene& scene, const RayCaster& rays, const ProbeLook& look,
                const std::optional<vec3>& prop);

}  // namespace lamplighter
