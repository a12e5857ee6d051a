// Irradiance at surface points: from the settled VPLs with exact shadows, from the path-traced
// reference, or from light that is stored on surfaces: interpolated, or gathered.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "renderer/bake/bake_points.h"
#include "renderer/bake/direct_light.h"
#include "renderer/bake/gathered_light.h"
#include "renderer/methods/path_tracer/path_tracer.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/sampling/vpl_set.h"
#include "renderer/surface_light/surface_light.h"

namespace lamplighter {

// `meshes`: bounced light is interpolated between the corners of surface elements, and direct light
// is computed at the point (DirectLight). `links`: the same direct light; the last bounce is
// gathered at the point from texels of the surface (GatheredLight).
enum class BakeMethod : uint8_t { settled, reference, meshes, links };

struct BakeLightOptions {
  BakeMethod method = BakeMethod::settled;
  VplCounts counts;  // settled; meshes, links: only the total of direct light, and the seed
  float clampDistance = 0.5f;    // settled: bound on 1/d² of a VPL [m]
  PathTracerOptions paths;       // reference
  int samples = 64;              // reference: paths per texel
  SurfaceLightOptions surface;   // meshes; links: only the mask of flat lights
  TexelRadiosityOptions texels;  // links
};

class BakedLight {
 public:
  // Keeps references to scene and rays.
  BakedLight(const RenderScene& scene, const RayCaster& rays, const BakeLightOptions& options);
  BakedLight(const BakedLight&) = delete;
  BakedLight& operator=(const BakedLight&) = delete;

  // Mean irradiance [W/m²] over the points of one texel. Ignores the normal map, which is finer
  // than texels. Points inside other objects do not count. If all points are inside, the result is
  // negative, which means unknown. `texel` is the index among all texels. The result depends only
  // on the arguments.
  vec3 irradiance(std::span<const BakePoint> points, uint32_t texel) const;

  // Side of the texels from which light is gathered, within the memory limit [m]; 0 with other
  // methods.
  float texelSide() const { return gathered_ ? gathered_->side() : 0.0f; }

 private:
  using Places = std::vector<std::pair<const BakePoint*, ReceivingPlace>>;
  ReceivingPlace placeOf(const BakePoint& point) const;
  vec3 ofPlace(const BakePoint& point, const ReceivingPlace& at) const;
  vec3 bounced(const BakePoint& point, const vec3& position) const;
  vec3 gathered(const Places& places) const;

  const RenderScene& scene_;
  const RayCaster& rays_;
  BakeLightOptions options_;
  LightSet lights_;
  std::vector<SceneVpl> vpls_;             // settled
  std::optional<DirectLight> direct_;      // meshes, links
  SurfaceLight surface_;                   // meshes
  std::optional<GatheredLight> gathered_;  // links
};

}  // namespace lamplighter
