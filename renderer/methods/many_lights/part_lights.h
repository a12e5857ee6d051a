// The lights of a picture that shows direct or bounced light alone, with light maps and stand-ins
// of their own: since the sums of light maps are exact, both parts add up to the whole.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "renderer/backends/kernels.h"
#include "renderer/light_maps/light_maps.h"
#include "renderer/light_maps/light_proxies.h"
#include "renderer/methods/inspection.h"
#include "renderer/methods/light_part.h"

namespace lamplighter {

class PartLights {
 public:
  // Of the lights that are shown those of the part. `all` says which slot is which light's.
  static std::vector<shared::Vpl> lightsOf(LightPart part, std::span<const shared::Vpl> shown,
                                           std::span<const InspectedLight> all);

  struct Maps {
    bool used = false;  // else all light is summed pixel by pixel
    LightMaps::Options options;
  };
  // Made anew: views are looked at while little changes. By slot `hasMap` and `isWanted` as
  // LightProxies takes them.
  void update(const RenderScene& scene, const VisibilityDatabase& visibility,
              std::span<const shared::Vpl> lights, size_t slots, const Maps& maps,
              const std::vector<uint8_t>& hasMap, const std::vector<uint8_t>& isWanted,
              const LightProxies::Groups& groups);
  void forget() { *this = PartLights(); }

  const LightMaps* maps() const { return maps_.get(); }
  const LightProxies& lightProxies() const { return lightProxies_; }

 private:
  std::unique_ptr<LightMaps> maps_;
  LightProxies lightProxies_;
};

// The picture without what `unlit` has: what shines itself, and the sky.
std::shared_ptr<RadianceImage> without(RadianceImage& unlit, RadianceImage& picture);

}  // namespace lamplighter
