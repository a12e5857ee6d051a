// The surfaces of area lights as triangles, so that everything downstream knows one kind of
// emitter.
#pragma once

#include "renderer/scene/scene.h"

namespace lamplighter {

// In the node's space, front faces towards −Z (a sphere or tube: outwards). A disk is a regular
// polygon, a sphere an icosphere and a tube a prism, all of exactly the true shape's area, so that
// flux is exact and only the outline is an approximation. The count of triangles depends on the
// shape alone.
Primitive tessellate(const AreaLight& light);

// Emitting area [m²] of a light whose node has this world matrix. Exact where the scale is equal on
// the axes that the shape has, else a disk is taken as an ellipse, a sphere by its mean radius and
// a tube by the mean radius of its section.
float areaOf(const AreaLight& light, const mat4& world);
// What is seen of it from the side that shows most: a sphere's circle, a tube's length × diameter.
float projectedAreaOf(const AreaLight& light, const mat4& world);

}  // namespace lamplighter
