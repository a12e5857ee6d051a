#include "renderer/methods/many_lights/part_lights.h"

namespace lamplighter {

void PartLights::update(const RenderScene& scene, const VisibilityDatabase& visibility,
                        const LightSampleTable& lights, const Maps& maps,
                        const LightProxies::Groups& groups) {
  lightProxies_.update(lights, groups);
  maps_.reset();
  if (!maps.used) return;
  maps_ = std::make_unique<LightMaps>();
  maps_->update(scene, visibility, lights.summed, maps.options);
}

}  // namespace lamplighter
