// Tessellates area lights, so that all later stages have only one kind of emitter.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// In the space of the node; front faces point to −Z (sphere and tube: outwards). A disk becomes a
// regular polygon, a sphere an icosphere and a tube a prism. The area equals that of the true
// shape, so the flux is exact; only the outline is approximate. The number of triangles depends
// only on the shape.
Primitive tessellate(const AreaLight& light);

// Emitting area [m²] of a light whose node has this world matrix. Exact if the scale is equal on
// all axes of the shape. Otherwise a disk is treated as an ellipse, a sphere has its mean radius
// and a tube the mean radius of its cross section.
float areaOf(const AreaLight& light, const mat4& world);
// Largest projected area [m²]: the circle of a sphere, length × diameter of a tube.
float projectedAreaOf(const AreaLight& light, const mat4& world);

}  // namespace lamplighter
