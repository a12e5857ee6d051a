// The direct light of one emitter at a point of a surface, per unit of its brightness: paper 4,
// equation (3).
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/sampling/emitters/lights.h"
#include "renderer/surface_light/blockers.h"
#include "renderer/surface_light/direct_meshes/split_tree.h"
#include "renderer/surface_light/emitter_factor.h"

namespace lamplighter {

class LightFactor {
 public:
  LightFactor(const RenderScene& scene, const RayCaster& rays, const Blockers& blockers,
              const LightSet& lights, size_t emitter, const VplId& id, uint32_t seed);

  // Number of samples by the way they were computed.
  struct Work {
    size_t open = 0, masks = 0;  // without blockers; with blockers in a mask
    uint64_t rays = 0;
    Work& operator+=(const Work& w) {
      open += w.open;
      masks += w.masks;
      rays += w.rays;
      return *this;
    }
  };
  // Irradiance of a vertex [W/m² per unit of brightness]. Flat light with few blockers: closed form
  // times the visible share of a bit mask. Other lights: rays to points all over the light.
  vec3 at(const SplitTree::Vertex& vertex, Work& work) const;
  // Irradiance without occlusion: by the closed form, or by the points. 0 below the surface.
  vec3 unshadowed(const vec3& position, const vec3& normal) const;

  // Points on the light that represent equal shares of its light; any leading part of the list is
  // well distributed, too.
  std::span<const EmitterPoint> points() const { return points_; }
  size_t emitter() const { return emitter_; }
  bool isLeftOutBy(uint32_t leftOutBy) const;

 private:
  struct Share {
    vec3 seen{0.0f};  // share of the light that arrives
    vec3 all{0.0f};   // without occlusion, by the points
  };
  Share shareOf(const SurfaceSpot& spot, Work& work) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  const Blockers& blockers_;
  uint32_t link_;
  size_t emitter_;
  EmitterFactor factor_;
  std::optional<FlatLight> flat_;
  std::vector<EmitterPoint> points_;
};

}  // namespace lamplighter
