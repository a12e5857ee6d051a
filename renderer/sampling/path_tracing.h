// The walk of one path from a light through the scene (paper 1, 4.1; Keller 1997): how it departs,
// what it meets, and the bounced VPLs that it leaves.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/directional_origins.h"
#include "renderer/sampling/emitters/lights.h"
#include "renderer/sampling/sample_streams.h"
#include "renderer/sampling/vpl_set.h"

namespace lamplighter {

// How a path leaves its light. World space.
struct Departure {
  // The density of directions about the normal: cos θ/π; the same everywhere within a cap; or one
  // direction alone (then where it starts is drawn).
  enum class Spread : uint8_t { cosine, cap, parallel };
  vec3 origin{0.0f}, direction{0.0f};
  vec3 normal{0.0f, 0.0f, 1.0f};
  vec3 flux{0.0f};  // that it carries if it were the only one [W]
  Spread spread = Spread::cosine;
  float cap = 2.0f;  // 1 − cos of its edge; 2: the whole sphere

  // Per steradian; 0 for parallel.
  float density(const vec3& towards) const;
  bool startsAs(const Departure& o) const { return origin == o.origin && direction == o.direction; }
};

// One ray of a path and what it met.
struct PathStep {
  vec3 origin{0.0f}, direction{0.0f};
  Hit hit;              // none: it left the scene
  vec3 position{0.0f};  // off the surface, on the side that it came from
  vec3 normal{0.0f};    // of the surface, to that side
  vec3 albedo{0.0f};

  bool ends() const;  // nothing goes on from there
};

// One path, as one of its light's sequence. Which steps it has does not depend on its flux.
struct LightPath {
  uint32_t index = 0;
  vec3 flux{0.0f};  // of its departure
  std::vector<PathStep> steps;
};

class PathWalker {
 public:
  // Keeps references to all but the counts.
  PathWalker(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
             const VplCounts& counts);

  // One of LightSet::emitters(), and its id: that of its VPLs without bounce and index.
  struct Source {
    int emitter = 0;
    VplId id;
  };
  // How path `index` departs by its own sample numbers. Traces nothing.
  Departure depart(const Source& source, uint32_t index) const;
  // The same start, towards another direction that two numbers in [0, 1)² choose.
  vec3 directionFrom(const Departure& start, vec2 u) const;
  // Its flux, did it leave that way.
  vec3 fluxAlong(const Source& source, const Departure& start, const vec3& direction) const;

  // Walks from the departure until the path ends or has all bounces. Returns the rays traced.
  int walk(const Source& source, const Departure& departure, LightPath& path) const;
  // Walks on: steps from `from` on are traced anew, the first of them along the ray it has.
  int walkOn(const Source& source, LightPath& path, size_t from) const;
  // What one ray meets.
  PathStep step(const vec3& origin, const vec3& direction) const;
  // Nothing goes on from what the light leaves out.
  void receive(const Source& source, PathStep& first) const;

  size_t bounces() const { return bounces_; }
  const SampleStreams& numbers() const { return numbers_; }
  const RenderScene& scene() const { return scene_; }
  const RayCaster& rays() const { return rays_; }

 private:
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

// The VPLs of a path of which there are 1/share, in the order of its bounces. `light`: a Source's
// id.
void addVpls(const SampleStreams& numbers, const VplId& light, const LightPath& path, float share,
             std::vector<SceneVpl>& vpls);
// How many those are.
size_t vplCount(const LightPath& path);

// The ids of all emitters, in their order: bounce and index are 0.
std::vector<VplId> emitterIds(const LightSet& lights);

// A point on an emitter that is a surface, the `index`th of the sequence.
struct EmitterSample {
  vec3 position, normal;
  vec3 flux;   // that it stands for, were it the only one [W]
  float area;  // the same [m²]
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
