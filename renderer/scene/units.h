// Conversion between metres and the unit of a RenderScene.
#pragma once

#include "renderer/scene/camera.h"

namespace lamplighter {

// The same view with lengths in units of `unit` metres. If these are below a metre, the near plane
// is at most 0.1 units from the eye: files tend to have the same one in any unit.
View inUnits(const View& metres, float unit);

// Bounds in units of `unit` metres, in metres. Empty bounds stay empty.
inline Bounds inMetres(const Bounds& b, float unit) { return {unit * b.min, unit * b.max}; }

}  // namespace lamplighter
