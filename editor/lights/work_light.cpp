#include "editor/lights/work_light.h"

#include <cmath>

namespace lamplighter {

float workLightIntensity(float distance, float exposureEv) {
  // I/d² · ρ/π = 0.06 · 2^−EV with ρ = 0.5. Nearer surfaces and bounced light are brighter.
  return 0.06f * std::exp2(-exposureEv) * kPi / 0.5f * distance * distance;
}

const Scene& WorkLight::with(const Scene& scene, const View& view, float intensity,
                             SceneChanges& changes) {
  const bool wasOn = isOn_;
  isOn_ = intensity > 0.0f;
  if (isOn_ != wasOn) changes.structure = true;
  if (!isOn_) {
    lit_ = Scene();
    return scene;
  }
  Node lamp;
  lamp.id = kWorkLight;
  lamp.name = "work light";
  lamp.local.translation = view.eye;
  lamp.punctual = PunctualLight{PunctualKind::point, vec3(intensity)};
  lit_ = scene;
  lit_.nodes.push_back(lamp);
  // stays on when other lights are solo
  if (!shiningLights(lit_).nodes.back()) lit_.nodes.back().light.solo = true;
  if (wasOn) {
    if (lamp.local.translation != lamp_.local.translation) changes.moved.push_back(kWorkLight);
    if (lamp.punctual != lamp_.punctual) changes.lights.push_back(kWorkLight);
  }
  lamp_ = lamp;
  return lit_;
}

}  // namespace lamplighter
