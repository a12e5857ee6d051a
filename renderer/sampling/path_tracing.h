// Walks one path from a light through the scene (paper 1, 4.1; Keller 1997): its departure, its
// hits and its indirect VPLs.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/directional_origins.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/sample_streams.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// How a path leaves its light, in world space.
struct Departure {
  // Density of directions around the normal: cos θ/π, uniform within a cap, or a single direction
  // (then the start position is sampled).
  enum class Spread : uint8_t { cosine, cap, parallel };
  vec3 origin{0.0f}, direction{0.0f};
  vec3 normal{0.0f, 0.0f, 1.0f};
  // The flux of the path if it were the only one [W], at the light's reference brightness.
  vec3 flux{0.0f};
  Spread spread = Spread::cosine;
  float cap = 2.0f;  // 1 − cos of the half-angle; 2: the whole sphere

  // Density of a direction [1/sr]; 0 for parallel.
  float density(const vec3& towards) const;
  bool startsAs(const Departure& o) const { return origin == o.origin && direction == o.direction; }
};

// One ray of a path and its hit.
struct PathStep {
  vec3 origin{0.0f}, direction{0.0f};
  Hit hit;              // no hit: it left the scene
  vec3 position{0.0f};  // offset from the surface to the side of the ray
  vec3 normal{0.0f};    // of the surface, on the side of the ray
  vec3 albedo{0.0f};

  bool ends() const;  // whether no light continues from here
};

// One path of its light's sequence. Its steps do not depend on its flux.
struct LightPath {
  uint32_t index = 0;
  vec3 flux{0.0f};  // at its departure
  std::vector<PathStep> steps;
};

class PathWalker {
 public:
  // Keeps references to all arguments except the counts.
  PathWalker(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
             const VplCounts& counts);

  // One of LightSet::emitters(), and the id of its VPLs with bounce and index 0.
  struct Source {
    int emitter = 0;
    VplId id;
  };
  // The departure of path `index` according to its own sample numbers. Traces no rays.
  Departure depart(const Source& source, uint32_t index) const;
  // A direction from the same start, selected by u in [0, 1)².
  vec3 directionFrom(const Departure& start, vec2 u) const;
  // The flux of a path that leaves in this direction.
  vec3 fluxAlong(const Source& source, const Departure& start, const vec3& direction) const;

  // Walks from the departure until the path ends or has all bounces. Returns the number of rays
  // traced.
  int walk(const Source& source, const Departure& departure, LightPath& path) const;
  // Traces the steps from index `from` to the end again; the first of them keeps its ray.
  int walkOn(const Source& source, LightPath& path, size_t from) const;
  // Traces one ray.
  PathStep step(const vec3& origin, const vec3& direction) const;
  // Ends the path if the light leaves out the object that was hit (light_linking.h).
  void receive(const Source& source, PathStep& first) const;

  size_t bounces() const { return bounces_; }
  const SampleStreams& numbers() const { return numbers_; }
  const RenderScene& scene() const { return scene_; }
  const RayCaster& rays() const { return rays_; }

 private:
  float reference(const Source& source) const;
  Departure departSurface(const Source& source, uint32_t index, vec2 u) const;
  Departure departPunctual(const Source& source, const RenderPunctual& p, uint32_t index,
                           vec2 u) const;
  Departure departParallel(const Source& source, const vec3& towards, const vec3& irradiance,
                           uint32_t index) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  const LightSet& lights_;
  SampleStreams numbers_;
  size_t bounces_;
  DirectionalOrigins parallelStart_;
};

// Appends the VPLs of one of 1/share paths, in the order of its bounces. `light`: the id of its
// Source. `isTurned`: with the tangents of their shadow maps; else those are 0.
void addVpls(const SampleStreams& numbers, const VplId& light, const LightPath& path, float share,
             bool isTurned, std::vector<SceneVpl>& vpls);
// The number of VPLs that addVpls() appends.
size_t vplCount(const LightPath& path);

// The ids of all emitters, in order; bounce and index are 0.
std::vector<VplId> emitterIds(const LightSet& lights);

// Sample number `index` on an emitter that is a surface.
struct EmitterSample {
  vec3 position, normal;
  vec3 flux;   // flux if it were the only sample [W], at the light's reference brightness
  float area;  // area if it were the only sample [m²]
};
EmitterSample sampleEmitter(const RenderScene& scene, const LightSet& lights,
                            const SampleStreams& numbers, const PathWalker::Source& source,
                            uint32_t index, uint32_t set);

// Angular attenuation of a spot as KHR_lights_punctual recommends: clamp(cos·scale + offset)².
struct SpotCone {
  explicit SpotCone(const PunctualLight& light);
  float at(float cosine) const;
  float scale, offset;
};

}  // namespace lamplighter
