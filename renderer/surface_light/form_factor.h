// The form factor of a polygon seen from a point, in closed form.
#pragma once

#include <span>

#include "renderer/base/math.h"

namespace lamplighter {

// Largest number of corners of a polygon.
inline constexpr size_t kMostCorners = 8;

// ∫ cos θ dω over the part of the polygon above the horizon of the unit normal n at x [sr]: the
// irradiance by a polygon of radiance 1 without occlusion (Lambert 1760; Baum, Rushmeier and
// Winget, "Improving Radiosity Solutions Through the Use of Analytically Determined Form-Factors",
// 1989). The polygon is planar and convex, with at most kMostCorners corners. Both sides emit: the
// caller must test the side of x. Computed in double precision; the error is about 1e-6 for
// polygons of 1e-3 sr or more.
float polygonFactor(const vec3& x, const vec3& n, std::span<const vec3> polygon);

// The contribution of the edge from a to b, both relative to x and not below the horizon of n, to
// twice that integral: the projected angle of the edge. Positive for edges that run
// counterclockwise about n.
double edgeFactor(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& n);

}  // namespace lamplighter
