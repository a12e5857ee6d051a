// Replaces the sum of light samples near a lamp by its form factor in closed form. Samples of a
// large lamp are spots: near it, surfaces show the spots, and the clamp of 1/d² removes light. The
// sum U without shadows is off by F − U, F the form factor times the radiance. The unblocked share
// of this difference is missing; the share is estimated as the ratio of sums with and without
// shadows (Heitz, Hill and McGuire, "Combining Analytic Direct Illumination and Stochastic
// Shadows", 2018).
#pragma once

#include <span>
#include <vector>

#include "renderer/bias_compensation/bias_compensation.h"
#include "renderer/bias_compensation/mesh_factor.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/light_controls.h"
#include "renderer/sampling/light_sample_table.h"

namespace lamplighter {

class NearLamps {
 public:
  // Lamps with samples in `table` and the same radiance everywhere, of at most
  // MeshFactor::kMostTriangles triangles; none without options.emission. All arguments must outlive
  // this object.
  NearLamps(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
            const LightSampleTable& table, const LightControls& controls,
            const BiasCompensation::Options& options);

  bool empty() const { return lamps_.empty(); }
  // By object, for BiasCompensation, which must not add the light of these lamps again.
  std::span<const uint8_t> exactLamps() const { return isExact_; }

  // The missing light at the pixels of these rows, shifted by `jitter`, at the reference brightness
  // of the lamps, as radiance of the surfaces; may be negative. `sample`: selects the random
  // numbers. `byRow`: for each row of the picture; groups are controls.
  void findRows(const View& view, vec2 jitter, uint32_t sample, int first, int last,
                std::span<std::vector<BiasCompensation::Contribution>> byRow) const;

 private:
  struct Lamp {
    VplId id;  // of its emitter
    uint32_t seed = 0, control = 0, link = 0;
    Bounds bounds;
    float radiance = 0.0f;  // at the reference brightness [W/(m² sr)]
    float reach = 0.0f;     // beyond this distance the samples suffice [m]
    MeshFactor factor;
    std::vector<shared::Vpl> vpls;  // its samples at the reference brightness
  };
  struct Point {
    vec3 position, normal, geometricNormal;  // normals on the side of the eye
    uint32_t leftOutBy = 0;
  };
  // The missing irradiance, without colour.
  float missingAt(const Lamp& lamp, const Point& point, float u, std::vector<float>& upTo) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  BiasCompensation::Options options_;
  std::vector<Lamp> lamps_;       // in the order of their ids, which does not depend on history
  std::vector<uint8_t> isExact_;  // by object
};

}  // namespace lamplighter
