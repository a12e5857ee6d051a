// Light that bounces between elements along the links: Jacobi iterations, without rays.
#pragma once

#include <span>
#include <vector>

#include "renderer/surface_light/gather_links.h"
#include "renderer/surface_light/light_smoothing.h"

namespace lamplighter {

// Bounced light, and direct light of the sky without suns.
enum class SurfaceLightPart { bounced, sky, both };

// Input of the bounces in addition to the links, by element or by sample.
struct SurfaceState {
  std::vector<vec3> albedo;  // by element: ρ, its mean
  // By element and corner: direct irradiance of the lights without the sky [W/m²].
  std::vector<vec3> direct;
  std::vector<vec3> sky;         // by sample: irradiance of the sky [W/m²]
  std::vector<uint8_t> isMixed;  // by element: whether a part of it is buried or behind a wall
  LightSmoothing smoothing;
};

// Radiance times π [W/m²] at the corners of elements: three of four floats each, for vectors of
// that size.
using ReflectedLight = std::vector<float>;

// The sum of the light at the hits of links. Divided by the number of links it is irradiance
// [W/m²].
vec3 gatheredLight(std::span<const GatherLink> links, const ReflectedLight& reflected);

// Computes the irradiance [W/m²] by bounced light of 1 to `bounces` bounces. Buried samples get the
// mean of their neighbours. `most`: links of a sample that the last bounce uses; earlier bounces
// use a quarter, because their noise is averaged again. `out`: the part `shown`, by value
// (SurfaceMesh::values()). `reflected`: light that elements reflect before the last bounce.
void bounceLight(const SurfaceMesh& mesh, const GatherLinks& links, const SurfaceState& state,
                 int bounces, int most, SurfaceLightPart shown, std::vector<vec3>& out,
                 ReflectedLight& reflected);

}  // namespace lamplighter
