// Places on a complex object at which light by transfer is compared with light by rays, light by
// light: what transfer gets wrong there decides which lights are left to the object's pixels.
#pragma once

#include <span>
#include <vector>

#include "renderer/prt/incident_light.h"
#include "renderer/prt/incident_light_points.h"

namespace lamplighter {

// In the object's own space.
struct ValidationPoint {
  // Light by transfer is, straight from a light, Σ direct · (what arrives at the light point).
  struct Term {
    uint8_t point;
    ShVector direct;
  };
  vec3 place, normal, plane;  // the normals: for shading, and of the triangle
  std::vector<Term> terms;
};

// On an object with so many light points: twice as many, 32 at least.
size_t validationPointsFor(size_t lightPoints);

// By area, as a pixel there comes by its light: the transfer of its triangle's vertices, each
// with the light points that it blends. `own`: as the transfer was computed of; `isLit`: by
// triangle, whether transfer lights it. Deterministic; none where the object has no such surface.
std::vector<ValidationPoint> placeValidationPoints(const RenderScene& own, const Transfer& transfer,
                                                   const IncidentLightPoints& points,
                                                   const std::vector<bool>& isLit);

// Of one light, in luminance of irradiance [W/m²].
struct LightError {
  float exact = 0.0f;  // by a ray
  float error = 0.0f;  // of what transfer says, from that
};

// By check point; none where nothing arrives at any, and nothing is wrong.
using LightErrors = std::vector<LightError>;

// Straight from a light. `places`: of the light points, in the world; `hidden`: of those, whether
// others hide the light. Adds to `traced` how many rays it took.
LightErrors checkLight(const std::vector<ValidationPoint>& checks, const OwnSpace& space,
                       const RayCaster& rays, const shared::Vpl& vpl, std::span<const vec3> places,
                       std::span<const uint8_t> hidden, float clampDistance, uint64_t& traced);

// Which lights to leave to pixels, so that what transfer gets wrong of the others stays, as the
// root of the mean square over the check points, below a share `mostError` of the light there: at
// most of the object's mean, where it is dark of a quarter of that. One by one, that of the largest
// error first; if these were more than one in six of those that matter, all. By slot; `isHeld`:
// whether transfer has it otherwise.
std::vector<bool> lightsToLeave(std::span<const LightErrors> lights,
                                const std::vector<bool>& isHeld, float mostError);

}  // namespace lamplighter
