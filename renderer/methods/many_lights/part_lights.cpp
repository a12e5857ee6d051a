#include "renderer/methods/many_lights/part_lights.h"

namespace lamplighter {

std::vector<shared::Vpl> PartLights::lightsOf(LightPart part, std::span<const shared::Vpl> shown,
                                              std::span<const InspectedLight> all) {
  std::vector<uint8_t> isDirect;
  for (const InspectedLight& light : all) {
    const auto slot = static_cast<size_t>(light.slot);
    if (light.slot < 0) continue;
    if (isDirect.size() <= slot) isDirect.resize(slot + 1, 0);
    isDirect[slot] = light.id.bounce == 0 ? 1 : 0;
  }
  std::vector<shared::Vpl> lights;
  for (const shared::Vpl& vpl : shown)
    if ((isDirect[static_cast<size_t>(vpl.intensity.w)] != 0) == (part == LightPart::direct))
      lights.push_back(vpl);
  return lights;
}

void PartLights::update(const RenderScene& scene, const VisibilityDatabase& visibility,
                        std::span<const shared::Vpl> lights, size_t slots, const Maps& maps,
                        const std::vector<uint8_t>& hasMap, const std::vector<uint8_t>& isWanted,
                        const LightProxies::Groups& groups) {
  lightProxies_.update(lights, slots, hasMap, isWanted, groups);
  maps_.reset();
  if (!maps.used) return;
  std::vector<shared::Vpl> bySlot(slots);
  for (const shared::Vpl& vpl : lights) bySlot[static_cast<size_t>(vpl.intensity.w)] = vpl;
  maps_ = std::make_unique<LightMaps>();
  maps_->update(scene, visibility, bySlot, maps.options);
}

std::shared_ptr<RadianceImage> without(RadianceImage& unlit, RadianceImage& picture) {
  const Image& taken = unlit.pixels();
  Image rest = picture.pixels();
  for (size_t i = 0; i < rest.pixels.size(); ++i) rest.pixels[i] -= taken.pixels[i];
  return std::make_shared<HostImage>(std::move(rest));
}

}  // namespace lamplighter
