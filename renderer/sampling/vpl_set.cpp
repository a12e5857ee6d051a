#include "renderer/sampling/vpl_set.h"

#include "renderer/sampling/light_gains.h"
#include "renderer/sampling/light_paths.h"
#include "renderer/sampling/sun_shadow_tiles.h"

namespace lamplighter {

VplSet generateVpls(const RenderScene& scene, const RayCaster& rays, const LightSet& lights,
                    const VplCounts& counts, const View* view) {
  VplSet set = LightPaths::generate(scene, rays, lights, counts);
  applyGains(lights, set.vpls);
  divideSuns(set.vpls, scene, rays, view, counts.sunMaps);
  return set;
}

bool isSameSun(const SceneVpl& a, const SceneVpl& b) {
  return a.isOfSun() && b.isOfSun() && a.id.set() == b.id.set();
}

int sampleCount(std::span<const SceneVpl> vpls) {
  int count = 0;
  for (size_t i = 0; i < vpls.size(); ++i) count += i == 0 || !isSameSun(vpls[i - 1], vpls[i]);
  return count;
}

}  // namespace lamplighter
