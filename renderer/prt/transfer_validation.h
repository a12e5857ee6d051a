// Check points on a complex object where the light by transfer is compared with the light by rays,
// for each light. The error of transfer there decides which lights the pixels of the object sum
// instead.
#pragma once

#include <span>
#include <vector>

#include "renderer/prt/incident_light.h"
#include "renderer/prt/incident_light_points.h"

namespace lamplighter {

// In the object's own space.
struct ValidationPoint {
  // The direct light by transfer is Σ direct · (light that arrives at the light point).
  struct Term {
    uint8_t point;
    ShVector direct;
  };
  vec3 place, normal, plane;  // normal: for shading; plane: normal of the triangle
  std::vector<Term> terms;
};

// For an object with this number of light points: twice as many, at least 32.
size_t validationPointsFor(size_t lightPoints);

// Distributed by area. A point receives its light like a pixel there: from the transfer of the
// vertices of its triangle, each with the light points that it blends. `own`: the scene that the
// transfer was computed from; `isLit`: by triangle, whether it is lit by transfer. Deterministic;
// none if no triangle is.
std::vector<ValidationPoint> placeValidationPoints(const RenderScene& own, const Transfer& transfer,
                                                   const IncidentLightPoints& points,
                                                   const std::vector<bool>& isLit);

// For one light, in luminance of irradiance [W/m²].
struct LightError {
  float exact = 0.0f;  // by a ray
  float error = 0.0f;  // of transfer, relative to `exact` (difference)
};

// By check point; empty if no light arrives at any point and there is no error.
using LightErrors = std::vector<LightError>;

// For the direct light of one light. `places`: the light points, world space; `hidden`: by light
// point, whether other objects block the light. Adds the number of rays to `traced`.
LightErrors checkLight(const std::vector<ValidationPoint>& checks, const OwnSpace& space,
                       const RayCaster& rays, const shared::Vpl& vpl, std::span<const vec3> places,
                       std::span<const uint8_t> hidden, float clampDistance, uint64_t& traced);

// Chooses by slot the lights that pixels sum instead of transfer, so that the remaining root mean
// square error over the check points is below the share `mostError` of the light there. The light
// at a point counts at most as the object's mean, and at least as a quarter of it. Lights are
// chosen one by one, the largest error first; if they are more than one sixth of the relevant
// lights, all are chosen. `isHeld`: whether transfer would otherwise hold the light in a slot.
std::vector<bool> lightsToLeave(std::span<const LightErrors> lights,
                                const std::vector<bool>& isHeld, float mostError);

}  // namespace lamplighter
