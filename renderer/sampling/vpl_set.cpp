#include "renderer/sampling/vpl_set.h"

#include "renderer/sampling/light_paths.h"

namespace lamplighter {

VplSet generateVpls(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                    const VplCounts& counts) {
  return LightPaths::generate(scene, rays, lights, counts);
}

}  // namespace lamplighter
