#include "editor/lights/new_light.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/error.h"
#include "renderer/scene/light_shapes.h"

namespace lamplighter {

namespace {

constexpr float kSpotInner = 0.35f, kSpotOuter = 0.7f;  // 20° and 40°
constexpr float kSunTilt = 0.6f;  // from straight down, so that shadows are visible

// The strength of a light, given its irradiance E at the distance for unit strength: 0.4 · 2^−EV ·
// π / E.
float strengthFor(float irradiance, float exposureEv) {
  return 0.4f * std::exp2(-exposureEv) * kPi / irradiance;
}

AreaLight areaLight(AreaShape shape, float distance, float exposureEv, float unit) {
  AreaLight light;
  light.shape = shape;
  const float size = std::clamp(0.3f * distance, 0.02f * unit, 2.0f * unit);
  light.size = vec2(size);
  if (shape == AreaShape::tube) light.size = vec2(2.0f * size, std::max(0.1f * size, 0.01f * unit));
  const float height = std::clamp(distance, 0.2f * unit, 3.0f * unit);
  // L A / h² · ρ/π = 0.4 · 2^−EV, where A is the area visible from below.
  light.radiance = vec3(0.4f * std::exp2(-exposureEv) * kPi * height * height /
                        projectedAreaOf(light, mat4(1.0f)));
  return light;
}

PunctualLight punctualLight(PunctualKind kind, float distance, float exposureEv, float unit) {
  PunctualLight light;
  light.kind = kind;
  const float height = std::clamp(distance, 0.2f * unit, 3.0f * unit);
  const bool isSun = kind == PunctualKind::directional;
  light.intensity = vec3(strengthFor(isSun ? 1.0f : 1.0f / (height * height), exposureEv));
  if (kind == PunctualKind::spot) {
    light.innerCone = kSpotInner;
    light.outerCone = kSpotOuter;
  }
  return light;
}

}  // namespace

const std::vector<std::string>& newLightKinds() {
  static const std::vector<std::string> kKinds = {"rectangle", "disk",  "sphere", "tube",
                                                  "spot",      "point", "sun"};
  return kKinds;
}

Node newLight(const std::string& kind, float distance, float exposureEv, float unit) {
  const auto& kinds = newLightKinds();
  const auto index = std::find(kinds.begin(), kinds.end(), kind) - kinds.begin();
  Node n;
  // Face down: map the light's −Z to the world's −Y.
  n.local.rotation = glm::angleAxis(-0.5f * kPi, vec3(1, 0, 0));
  if (index < 4) {
    n.area = areaLight(static_cast<AreaShape>(index), distance, exposureEv, unit);
  } else if (index < static_cast<ptrdiff_t>(kinds.size())) {
    static constexpr PunctualKind kPunctual[] = {PunctualKind::spot, PunctualKind::point,
                                                 PunctualKind::directional};
    n.punctual = punctualLight(kPunctual[index - 4], distance, exposureEv, unit);
  } else {
    throw InputError(kind, "is not a kind of light",
                     "give rectangle, disk, sphere, tube, spot, point or sun");
  }
  if (kind == "sun")
    n.local.rotation =
        glm::angleAxis(-0.5f * kPi + kSunTilt, vec3(1, 0, 0)) * glm::angleAxis(0.3f, vec3(0, 1, 0));
  return n;
}

}  // namespace lamplighter
