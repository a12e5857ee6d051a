// Projects points from the world to viewport pixels and back, for tools and overlays.
#pragma once

#include <optional>
#include <vector>

#include "editor/tools/overlay.h"
#include "renderer/scene/camera.h"

namespace lamplighter {

// The part of a segment in front of the eye, in viewport pixels. None if all of it is behind.
struct Segment2 {
  vec2 a, b;
};
std::optional<Segment2> projectSegment(const View& view, vec3 a, vec3 b);
std::optional<vec2> projectPoint(const View& view, const vec3& p);

// The world-space size [m] of a pixel at the distance of p.
float metresPerPixel(const View& view, const vec3& p);

// The point where the ray through a pixel hits a plane with a unit normal. None behind the eye,
// parallel to the plane, or so near the horizon that a pixel spans kilometres.
std::optional<vec3> onPlane(const View& view, const vec2& pixel, const vec3& origin,
                            const vec3& normal);

float distanceToSegment(const vec2& p, const vec2& a, const vec2& b);

// Adds a world-space line or closed loop to an overlay, clipped at the eye.
void addLine(Overlay& overlay, const View& view, const vec3& a, const vec3& b, const vec4& colour,
             float thickness = 1.5f);
void addLoop(Overlay& overlay, const View& view, const std::vector<vec3>& points,
             const vec4& colour, float thickness = 1.5f);

// Points of a circle around `centre` in the plane of the unit vectors u and v.
std::vector<vec3> circle(const vec3& centre, const vec3& u, const vec3& v, float radius,
                         int sides = 48);

}  // namespace lamplighter
