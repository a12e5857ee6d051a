// Renders in tests without files and without a backend.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/scene/camera.h"
#include "renderer/scene/scene.h"

namespace lamplighter::test {

// The path tracer's picture.
Image renderReference(const Scene& scene, const View& view, int samples, int bounces,
                      uint32_t seed = 1);

// A view from `eye` to `target`.
View lookAt(const vec3& eye, const vec3& target, int width, int height, float yfov = 0.8f);

vec3 meanOf(const Image& image);

// The form factor from a point with unit normal n to a polygon that is completely above its horizon
// and counter-clockwise as seen from the point: Lambert's formula, 1/2π Σ Γᵢ · n.
double polygonFormFactor(const vec3& x, const vec3& n, const std::vector<vec3>& polygon);

}  // namespace lamplighter::test
