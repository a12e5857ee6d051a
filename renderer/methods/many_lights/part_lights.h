// The lights of a picture that shows only direct or only indirect light, with their own light maps
// and light proxies. The sums of light maps are exact, so both parts add up to the whole.
#pragma once

#include <memory>
#include <vector>

#include "renderer/backends/radiance_image.h"
#include "renderer/light_maps/light_maps.h"
#include "renderer/light_maps/light_proxies.h"

namespace lamplighter {

class PartLights {
 public:
  struct Maps {
    bool used = false;  // otherwise all light is summed per pixel
    LightMaps::Options options;
  };
  // Recomputes everything: these views are used while little changes. `lights`: the lights of the
  // part are summed.
  void update(const RenderScene& scene, const VisibilityDatabase& visibility,
              const LightSampleTable& lights, const Maps& maps, const LightProxies::Groups& groups);
  void forget() { *this = PartLights(); }

  const LightMaps* maps() const { return maps_.get(); }
  const LightProxies& lightProxies() const { return lightProxies_; }

 private:
  std::unique_ptr<LightMaps> maps_;
  LightProxies lightProxies_;
};

}  // namespace lamplighter
