// A surface point on a path of the reference.
#pragma once

#include <algorithm>
#include <optional>

#include "renderer/methods/path_tracer/glossy_surface.h"
#include "renderer/raycast/ray_caster.h"
#include "renderer/scene/surface.h"

namespace lamplighter {

// Uniform density of directions on the sphere [1/sr].
inline constexpr float kUniformDensity = 1.0f / (4.0f * kPi);

// A surface seen from one side: both normals are turned to the viewer. A mapped normal that faces
// away from the viewer is bent to the geometric one. Lambertian if it has no gloss.
struct LocalSurface {
  Surface s;
  vec3 ng, ns;
  std::optional<GlossySurface> gloss;
  uint32_t leftOutBy;  // light_linking.h
  // A point in space without surface, which receives light from all directions equally.
  bool isSpace = false;

  LocalSurface(const Surface& surface, const vec3& toViewer, uint32_t links)
      : s(surface), leftOutBy(links) {
    const float side = glm::dot(s.geometricNormal, toViewer) < 0.0f ? -1.0f : 1.0f;
    ng = side * s.geometricNormal;
    ns = side * s.normal;
    if (glm::dot(ns, toViewer) <= 0.0f) ns = ng;
  }
  explicit LocalSurface(const vec3& place) : ng(0.0f), ns(0.0f), leftOutBy(0), isSpace(true) {
    s.position = place;
  }
  // Cosine with the shading normal; 0 for directions below the real surface, where light would
  // leak.
  float cosine(const vec3& w) const {
    return glm::dot(ng, w) > 0.0f ? std::max(0.0f, glm::dot(ns, w)) : 0.0f;
  }
  // The BRDF f times cos for light from w; 1 in space.
  vec3 reflected(const vec3& w) const {
    if (isSpace) return vec3(1.0f);
    const vec3 f = gloss ? gloss->brdf(w) : s.albedo / kPi;
    return f * cosine(w);
  }
  // The probability density per solid angle with which a path continues towards w.
  float pdf(const vec3& w) const {
    if (isSpace) return kUniformDensity;
    return gloss ? gloss->pdf(w) : std::max(0.0f, glm::dot(ns, w)) / kPi;
  }
};

// Origin of rays that leave the surface.
inline vec3 rayOrigin(const LocalSurface& at) {
  return at.s.position + rayEpsilon(at.s.position) * at.ng;
}

}  // namespace lamplighter
