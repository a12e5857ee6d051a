#include "renderer/prt/incident_light.h"

#include <algorithm>
#include <cmath>

namespace lamplighter {
namespace {

constexpr float kMostIrradiance = 65536.0f;  // [W/m²]
// Limit of a ray's hits on one object: guarantees termination, far above any real object.
constexpr int kMostWalls = 256;

}  // namespace

std::optional<IncidentLight> incidentLight(const shared::Vpl& vpl, const vec3& point,
                                           float clampDistance) {
  const vec3 position(vpl.position), axis(vpl.normal), tangent(vpl.tangent);
  const vec3 v = point - position;
  IncidentLight out;
  float weight = 0.0f;
  if (vpl.position.w == shared::kVplDirectional) {
    const float x = glm::dot(v, tangent), y = glm::dot(v, glm::cross(axis, tangent));
    const float side = vpl.tangent.w;
    if (x < -side || x >= side || y < -side || y >= side) return std::nullopt;
    out.direction = axis;
    out.distance = std::numeric_limits<float>::infinity();
    weight = 1.0f;
  } else {
    const float height = glm::dot(v, axis), d2 = glm::dot(v, v);
    if (!(height > 0.0f)) return std::nullopt;
    const float d = std::sqrt(d2), cosine = height / d;
    out.direction = -v / d;
    out.distance = d;
    if (vpl.position.w == shared::kVplCosine) {
      weight = cosine / std::max(d2, clampDistance * clampDistance);
    } else {
      const float cone = std::clamp(cosine * vpl.normal.w + vpl.tangent.w, 0.0f, 1.0f);
      weight = cone * cone / d2;
    }
  }
  out.irradiance = glm::min(weight * vpl.intensity, kMostIrradiance);
  if (!(std::max({out.irradiance.r, out.irradiance.g, out.irradiance.b}) > 0.0f))
    return std::nullopt;
  return out;
}

bool isHiddenByOthers(const RayCaster& rays, uint32_t object, const vec3& point,
                      const IncidentLight& light) {
  const float step = rayEpsilon(point);
  Ray ray{point, 0.0f, light.direction, light.distance - 2.0f * step};
  for (int wall = 0; wall < kMostWalls && ray.tNear < ray.tFar; ++wall) {
    const Hit hit = rays.intersect(ray);
    if (!hit) return false;
    if (hit.object != object) return true;
    ray.tNear = hit.t + step;
  }
  return false;
}

bool liesOn(const RayCaster& rays, uint32_t object, const shared::Vpl& vpl) {
  if (vpl.position.w != shared::kVplCosine) return false;
  const vec3 position(vpl.position), normal(vpl.normal);
  // The VPL is offset from its surface by rayEpsilon().
  const float step = rayEpsilon(position);
  const Hit hit = rays.intersect({position + step * normal, 0.0f, -normal, 4.0f * step});
  return hit && hit.object == object;
}

}  // namespace lamplighter
