// Whether a place of a surface lies inside of another object, where no light is wanted.
#pragma once

#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

// By a few rays: most of them hit back faces that no camera sees. `key`: chooses the rays.
bool isInside(const RenderScene& scene, const RayCaster& rays, const ReceivingPlace& at,
              uint32_t key);

}  // namespace lamplighter
