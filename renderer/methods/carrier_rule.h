// What carries bounced light where the user leaves it to the scene: a rule on the scene alone, so
// that pictures do not depend on the machine.
#pragma once

#include <string>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

enum class BouncedCarrier : uint8_t { meshes, links, imperfect };

struct CarrierChoice {
  BouncedCarrier carrier = BouncedCarrier::meshes;
  std::string reason;  // half a sentence
};

// Links of texels for rooms whose surfaces are larger than texels: bounced light costs least there
// while lamps move, and has the least error. Meshes where surfaces are finer than texels, where the
// sky gives light (its direct light is on meshes, too), and where surfaces are glossy (mirrors see
// meshes). Samples with imperfect shadow maps where meshes would take seconds for an edit: levels
// of very many triangles without a sky, or of many lamps. `texel`: wanted side [m].
CarrierChoice carrierFor(const RenderScene& scene, float texel);

}  // namespace lamplighter
