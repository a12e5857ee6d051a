// The service that finds light on surfaces by itself: bounced light, smooth, of any number of
// bounces, current in every frame.
//
// Elements of all surfaces (surface_mesh.h) get direct light from each emitter (direct_factors.h)
// and exchange it along kept rays (gather_links.h, bounced_light.h). Edits of brightness trace no
// ray; those of places trace again what they touch. The result has the bits of a fresh start.
#pragma once

#include "renderer/surface_light/bounced_light.h"
#include "renderer/surface_light/direct_factors.h"

namespace lamplighter {

struct SurfaceLightOptions {
  int bounces = 2;
  float edge = 0.25f;  // longest edge of an element where memory allows it [m]
  int gatherRays = 256;
  size_t linkBytes = size_t{256} << 20;
  int mask = 0;  // DirectFactors::Scene
  uint32_t seed = 1;
  bool operator==(const SurfaceLightOptions&) const = default;
};

class SurfaceLight {
 public:
  // Work of the last update, and what there is.
  struct Counts {
    uint64_t rays = 0;         // traced
    size_t samplesTraced = 0;  // of which at least one ray was traced
    size_t masks = 0;          // of them, drawn
    size_t factorsFound = 0;   // direct light of an emitter on an element
    size_t samples = 0, leaves = 0, bytes = 0;
    float edge = 0.0f;  // longest edge [m]
  };

  // Brings everything up to date. `changes`: since the last update. Returns whether the light may
  // have changed.
  bool update(const RenderScene& scene, const RenderSceneChanges& changes, const RayCaster& rays,
              const SurfaceLightOptions& options);
  void forget() { *this = SurfaceLight(); }

  // Irradiance of bounced light by value of the mesh [W/m²]. SurfacePicture shows it.
  const std::vector<vec3>& values() const { return bounced_; }

  const SurfaceMesh& mesh() const { return mesh_; }
  const CutLeaves& cuts() const { return cuts_; }
  const GatherLinks& links() const { return links_; }
  const Counts& counts() const { return counts_; }

 private:
  void findAlbedo(const RenderScene& scene);
  void findMixed();
  void findSky(const RenderScene& scene);

  SurfaceLightOptions options_;
  LightSet lights_;
  SurfaceMesh mesh_;
  CutLeaves cuts_;
  GatherLinks links_;
  DirectFactors direct_;
  SurfaceState state_;
  std::vector<vec3> bounced_;  // by value
  Sky sky_;                    // of state_.sky
  Counts counts_;
};

}  // namespace lamplighter
