// Chooses the carrier of bounced light for `indirect=automatic`: a rule that depends only on the
// scene, so that pictures do not depend on the machine.
#pragma once

#include <string>

#include "renderer/scene/render_scene.h"

namespace lamplighter {

enum class BouncedCarrier : uint8_t { meshes, links, imperfect };

struct CarrierChoice {
  BouncedCarrier carrier = BouncedCarrier::meshes;
  std::string reason;  // for messages: part of a sentence
};

// Links of texels: for rooms whose surfaces are larger than texels; there they have the lowest cost
// while lamps move, and the smallest error. Meshes: if surfaces are finer than texels, if there is
// a sky (its direct light is on meshes, too), and if surfaces are glossy (mirrors show meshes).
// Samples with imperfect shadow maps: if meshes would take seconds for an edit, in levels of very
// many triangles without a sky, or with many lamps. `texel`: requested side of texels [m].
CarrierChoice carrierFor(const RenderScene& scene, float texel);

}  // namespace lamplighter
