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

  // How a sample was found.
  struct Work {
    size_t open = 0, masks = 0;  // nothing is between; blockers were drawn into a mask
    uint64_t rays = 0;
    Work& operator+=(const Work& w) {
      open += w.open;
      masks += w.masks;
      rays += w.rays;
      return *this;
    }
  };
  // Of a flat light with few blockers by its closed form times the visible share of a mask; of
  // others by rays to places all over the light. [W/m² per unit of brightness]
  vec3 at(const SplitTree::Vertex& vertex, Work& work) const;
  // If nothing were between: by the closed form, or by the points. 0 below the surface.
  vec3 unshadowed(const vec3& position, const vec3& normal) const;

  // Places on the light, in equal shares of its light; so are the first few of them.
  std::span<const EmitterPoint> points() const { return points_; }
  size_t emitter() const { return emitter_; }
  bool isLeftOutBy(uint32_t leftOutBy) const;

 private:
  struct Share {
    vec3 seen{0.0f};  // share of the light that arrives
    vec3 all{0.0f};   // if nothing were between, by the points
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
