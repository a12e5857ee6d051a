// A surface with the metallic-roughness BRDF (shaders/shared/brdf.h) for the path tracer:
// evaluation, and sampling by a mixture of cosine and specular lobe.
#pragma once

#include "renderer/scene/surface.h"
#include "shaders/shared/brdf.h"

namespace lamplighter {

// Whether the microfacet distribution is computed from the cosine of the half vector, as in brdf.h,
// or from its sine. With the cosine, rounding makes narrow lobes brighter (by 1% at roughness
// 0.05); the sine avoids this.
enum class LobeArithmetic { fromCosine, fromSine };

class GlossySurface {
 public:
  // normal: the shading normal on the side of the eye; toEye: unit vector. World space.
  GlossySurface(const vec3& baseColor, const Gloss& gloss, float leastRoughness, const vec3& normal,
                const vec3& toEye, LobeArithmetic arithmetic);

  // The BRDF f for light from the unit direction w [1/sr]; 0 below the surface.
  vec3 brdf(const vec3& w) const;
  // sample(): a direction from the lobe or the cosine, as `choice` decides. pdf(): its
  // probability density per solid angle; 0 below the surface, where a lobe sample may point.
  vec3 sample(float choice, vec2 u) const;
  float pdf(const vec3& w) const;

 private:
  vec3 lobeTowards(const vec3& light) const;

  LobeArithmetic arithmetic_;
  Frame frame_;
  vec3 eye_;  // in the local frame
  float alpha_ = 1.0f, lobeProbability_ = 0.0f;
  vec3 diffuse_;  // ρ/π × diffuse share
  shared::Lobe lobe_;
};

}  // namespace lamplighter
