#include "renderer/sampling/light_gains.h"

#include "renderer/sampling/path_tracing.h"
#include "renderer/scene/vpl.h"

namespace lamplighter {

LightGains gainsOf(const LightSet& lights) {
  LightGains gains;
  const std::vector<VplId> ids = emitterIds(lights);
  for (size_t i = 0; i < ids.size(); ++i) gains[ids[i]] = lights.emitters()[i].gain;
  return gains;
}

void applyGains(const LightSet& lights, std::vector<SceneVpl>& vpls) {
  const LightGains gains = gainsOf(lights);
  for (SceneVpl& v : vpls) v.vpl.intensity *= gainOf(gains, v.id);
  std::erase_if(vpls, [](const SceneVpl& v) { return !(brightness(v.vpl) > 0.0f); });
}

}  // namespace lamplighter
