// A surface with the metallic-roughness BRDF (shaders/shared/brdf.h), for the path tracer:
// evaluated, and sampled by a mixture of the cosine and the lobe.
#pragma once

#include "renderer/scene/surface.h"
#include "shaders/shared/brdf.h"

namespace lamplighter {

class GlossySurface {
 public:
  // normal: the shading normal on the side of the eye; toEye: unit. World space.
  GlossySurface(const vec3& baseColor, const Gloss& gloss, float leastRoughness, const vec3& normal,
                const vec3& toEye);

  // f for light from the unit direction w [1/sr], 0 below the surface.
  vec3 brdf(const vec3& w) const;
  // A direction, by `choice` from the lobe or the cosine, and the density with which it is taken,
  // by solid angle; 0 below the surface, where the lobe's may point.
  vec3 sample(float choice, vec2 u) const;
  float pdf(const vec3& w) const;

 private:
  Frame frame_;
  vec3 eye_;  // in the frame
  float alpha_ = 1.0f, lobeProbability_ = 0.0f;
  vec3 diffuse_;  // ρ/π × its share
  shared::Lobe lobe_;
};

}  // namespace lamplighter
