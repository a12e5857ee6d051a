// Whether a point of a surface lies inside another object, where light is not needed.
#pragma once

#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

// Tested by a few rays: most of them hit back faces of single-sided surfaces, which no camera sees.
// `key`: selects the rays.
bool isInside(const RenderScene& scene, const RayCaster& rays, const ReceivingPlace& at,
              uint32_t key);

}  // namespace lamplighter
