// The light samples over the picture: where they are, where they shine, which of them wait.
#pragma once

#include "editor/tools/overlay.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// Discs on lights, diamonds for bounces, squares for parallel light where it lands, in the colour
// of their light, each with its normal; a ring around those that wait, a larger one around the
// chosen (kNone: none). What surfaces hide is faint.
void drawVpls(Overlay& overlay, const View& view, const Inspection& inspection,
              const RayCaster& rays, int chosen);

// The one whose mark is under the pointer, those that are seen first; kNone where there is none.
int pickVpl(const View& view, const Inspection& inspection, const RayCaster& rays,
            const vec2& pointer);

}  // namespace lamplighter
