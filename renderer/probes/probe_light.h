// Incident light at probes, as spherical harmonics.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/probes/probe_grid.h"

namespace lamplighter {

inline constexpr size_t kProbeCoefficients = 9;

// Coefficients of the incident radiance L(ω) [W/(m² sr)] at a point, linear Rec. 709:
//   c(l, m) = ∫ L(ω) Y(l, m)(ω) dω
// with ω the direction to where the light comes from, in world space (right-handed, Y up). Real
// spherical harmonics of order 3 (bands 0 to 2), orthonormal, without the Condon-Shortley phase, at
// index l(l + 1) + m as in renderer/prt/spherical_harmonics.h:
//   1/2 √(1/π),  1/2 √(3/π) {y, z, x},
//   1/2 √(15/π) {x y, y z},  1/4 √(5/π) (3 z² − 1),  1/2 √(15/π) x z,  1/4 √(15/π) (x² − y²).
using ProbeSh = std::array<vec3, kProbeCoefficients>;

// The nine functions of a unit vector.
std::array<float, kProbeCoefficients> probeBasis(const vec3& direction);
// Adds light [W/m²: radiance times solid angle] from a unit direction.
void addLight(ProbeSh& sh, const vec3& towards, const vec3& light);
// Irradiance [W/m²] on a surface with this unit normal: convolution with the cosine lobe, which
// multiplies the bands by π, 2π/3 and π/4 (Ramamoorthi and Hanrahan 2001). A single small light
// exceeds its cosine by up to 6% of its irradiance on a surface that faces it, and may give
// negative values to surfaces that face away: users clamp them to 0.
vec3 irradianceFrom(const ProbeSh& sh, const vec3& normal);

// Fills in the coefficients of places [unit of the scene]; both spans have the same size. So other
// sources of light than the reference can serve probes.
using ProbeSource = std::function<void(std::span<const vec3> places, std::span<ProbeSh> out)>;

// Light at points of space by the path tracer. Punctual lights (points, spots, suns) are exact: one
// ray each. Emissive surfaces and the sky are sampled as lights as well as by directions. Random
// numbers depend on the place, the number of the sample and the seed. Several threads may call it.
class ProbeReference {
 public:
  // Keeps references to scene and rays. Uses the bounces and the seed of the options. `before`: the
  // lights of an earlier state of the scene; unchanged ones are reused.
  ProbeReference(const RenderScene& scene, const RayCaster& rays, const PathTracerOptions& paths,
                 const LightSet& before = {});

  // Adds the samples first … first + count − 1 of a place to their sum.
  void addSamples(const vec3& place, uint32_t first, uint32_t count, ProbeSh& sum) const;
  // Only the light of punctual lights.
  ProbeSh punctualLight(const vec3& place) const;
  // All light, by `samples` samples; powers of two are stratified best.
  ProbeSh light(const vec3& place, uint32_t samples) const;
  // A ProbeSource for many places in parallel. Keeps a reference to this object.
  ProbeSource source(uint32_t samples) const;
  const LightSet& lights() const { return lights_; }

 private:
  const RenderScene& scene_;
  const RayCaster& rays_;
  PathTracerOptions paths_;
  LightSet lights_;
};

// Light of the valid probes of a grid; that of others is 0. `progress` is called after each batch
// of probes, with the number of valid probes that are done and of all; returning false stops, and
// the result is empty. With the reference the result does not depend on the number of threads.
using ProbeProgress = std::function<bool(int done, int all)>;
std::vector<ProbeSh> probeLight(const ProbeGrid& grid, const ProbeSource& source,
                                const ProbeProgress& progress);

// Changes the state of valid probes at which no light arrives at all, in two cases in which they
// would darken interpolated light near walls:
//
// - Inside a double-sided object, whose inside placeProbes() cannot detect: more than half of the
//   rays hit back faces (Probe::behind). They become inside.
// - Beside a level without sky and sun, such as around a closed house: more than half of the rays
//   hit nothing (Probe::open). They become dark.
//
// Others stay valid: dark rooms are dark.
void markUnlit(const RenderScene& scene, std::span<const ProbeSh> light, ProbeGrid& grid);

// The light at a place by trilinear interpolation between the eight nodes around it (the nearest
// ones outside the grid), with valid probes only: the weights are normalised. None if none is
// valid. `light`: of all probes.
std::optional<ProbeSh> interpolatedLight(const ProbeGrid& grid, std::span<const ProbeSh> light,
                                         const vec3& place);

// Gives each invalid probe the mean of those of its up to six neighbours that have light,
// propagated outwards, so that trilinear interpolation does not darken near walls. Without valid
// probes all are 0.
void fillInvalid(const ProbeGrid& grid, std::span<ProbeSh> light);

}  // namespace lamplighter
