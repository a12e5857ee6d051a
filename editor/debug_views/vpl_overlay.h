// Draws over the picture where the method computes light: its light samples with their directions
// and which of them wait for an update, its other points, and its links.
#pragma once

#include "editor/tools/overlay.h"
#include "renderer/methods/inspection.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// Discs mark samples on lights, diamonds bounces, and squares the points that parallel light hits.
// Each mark has the colour of its light and shows the normal. A ring marks the samples that wait
// for an update, a larger ring the chosen one (kNone: none). Marks behind surfaces are faint.
// Points of the method are triangles, links are lines that are fainter the less they carry. Views
// are in the unit of the scene, as are the inspection and the rays.
void drawVpls(Overlay& overlay, const View& view, const Inspection& inspection,
              const RayCaster& rays, int chosen);

// Index of the sample whose mark is under the pointer, visible marks first. kNone if there is none.
int pickVpl(const View& view, const Inspection& inspection, const RayCaster& rays,
            const vec2& pointer);

}  // namespace lamplighter
