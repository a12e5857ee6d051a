// Generates the VPLs on the lights themselves (paper 1, 4.1).
#pragma once

#include <vector>

#include "renderer/sampling/path_tracing.h"
#include "renderer/sampling/vpl_counts.h"

namespace lamplighter {

// The wanted number of direct samples.
int directSamples(const VplCounts& counts);
// The share of an emitter by its flux, with its minimum number of samples. The sides of a
// double-sided one alternate; a point light is two hemispheres; one with a profile has its lobes. A
// sun is one sample, independent of its tiles. Zero for emitters that the counts leave out.
SampleShare directShareOf(const RenderScene& scene, const Emitter& e, const VplCounts& counts);

class DirectVpls {
 public:
  DirectVpls(const RenderScene& scene, const LightSet& lights, const VplCounts& counts)
      : scene_(scene), lights_(lights), numbers_(counts), batch_(counts.batch) {}

  // Appends `count` samples of one emitter at its reference brightness, multiplied by `scale`.
  void add(const PathWalker::Source& source, int count, float scale,
           std::vector<SceneVpl>& vpls) const;

 private:
  SkyMap::Light skySun(const Emitter& e, const VplId& id) const;
  void addPunctual(const RenderPunctual& p, VplId id, const vec3& intensity,
                   std::vector<SceneVpl>& vpls) const;
  void addSun(const vec3& towards, const vec3& irradiance, VplId id,
              std::vector<SceneVpl>& vpls) const;
  SceneVpl directional(const VplId& id, const vec3& towards, const vec3& irradiance) const;

  const RenderScene& scene_;
  const LightSet& lights_;
  SampleStreams numbers_;
  uint32_t batch_;
};

}  // namespace lamplighter
