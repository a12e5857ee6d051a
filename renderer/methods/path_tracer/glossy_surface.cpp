#include "renderer/methods/path_tracer/glossy_surface.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// The density of directions from sampleVisibleNormal() per solid angle: D·G1 / (4 n·v), with
// D = α² / (π d²).
float visibleNormalPdf(float nv, float d, float a2) {
  const float distribution = a2 / (kPi * d * d);
  return distribution / (2.0f * (nv + std::sqrt(nv * nv * (1.0f - a2) + a2)));
}

// brdf.h has no smaller cosine with the eye than kLeastCosine. An eye below that is lifted to it,
// so that sampled directions and their densities are those of the same lobe: otherwise single paths
// at the rims of glossy objects were 10⁵ times too bright.
vec3 lifted(const vec3& eye) {
  constexpr float kLeast = shared::kLeastCosine;
  if (eye.z >= kLeast) return eye;
  const float scale = std::sqrt((1.0f - kLeast * kLeast) / (eye.x * eye.x + eye.y * eye.y));
  return {scale * eye.x, scale * eye.y, kLeast};
}

// The same as in brdf.h, including its rounding errors: in narrow lobes at grazing angles these are
// large, and the density must include them, too.
float denominatorFromCosine(const vec3& light, const vec3& eye, float a2) {
  const float vh2 = std::max(0.5f + 0.5f * glm::dot(light, eye), 1e-6f), sum = light.z + eye.z;
  return std::min(sum * sum / (4.0f * vh2), 1.0f) * (a2 - 1.0f) + 1.0f;
}

// d = cos² θ (α² − 1) + 1 = cos² θ α² + sin² θ for the angle θ of the half vector.
float denominatorFromSine(const vec3& light, const vec3& eye, float a2) {
  const vec3 sum = light + eye;
  const float sine2 = (sum.x * sum.x + sum.y * sum.y) / std::max(glm::dot(sum, sum), 4e-6f);
  return (1.0f - sine2) * a2 + sine2;
}

}  // namespace

GlossySurface::GlossySurface(const vec3& baseColor, const Gloss& gloss, float leastRoughness,
                             const vec3& normal, const vec3& toEye, LobeArithmetic arithmetic)
    : arithmetic_(arithmetic), frame_(normal), eye_(lifted(frame_.toLocal(toEye))) {
  const float nv = eye_.z;
  lobe_ = shared::makeLobe(baseColor, gloss.metallic, gloss.roughness, leastRoughness, nv);
  alpha_ = std::sqrt(lobe_.shape.x);
  const float share = shared::diffuseShare(gloss.metallic, gloss.roughness, leastRoughness, nv);
  diffuse_ = share / kPi * baseColor;
  const float away = 1.0f - nv, grazing = away * away * away * away * away;
  const float straight = luminance(vec3(lobe_.straight));
  const float lobe = straight + (lobe_.straight.w - straight) * grazing;
  const float diffuse = share * luminance(baseColor);
  // Both probabilities are positive, because both lobes cover the whole hemisphere.
  lobeProbability_ = diffuse > 0.0f ? std::clamp(lobe / (lobe + diffuse), 0.1f, 0.9f) : 1.0f;
}

vec3 GlossySurface::brdf(const vec3& w) const {
  const vec3 light = frame_.toLocal(w);
  if (light.z <= 0.0f) return vec3(0.0f);
  return diffuse_ + lobeTowards(light);
}

// D·V·F, equal to shared::lobeTowards() except for rounding.
vec3 GlossySurface::lobeTowards(const vec3& light) const {
  if (arithmetic_ == LobeArithmetic::fromCosine)
    return shared::lobeTowards(lobe_, light.z, glm::dot(light, eye_), 0.0f);
  const float a2 = lobe_.shape.x, nv = lobe_.shape.y, nl = light.z;
  const float d = denominatorFromSine(light, eye_, a2);
  const float masking =
      nl * std::sqrt(nv * nv * (1.0f - a2) + a2) + nv * std::sqrt(nl * nl * (1.0f - a2) + a2);
  const float away = 1.0f - 0.5f * glm::length(light + eye_), away2 = away * away;
  const vec3 straight(lobe_.straight);
  const vec3 fresnel = straight + away2 * away2 * away * (lobe_.straight.w - straight);
  return a2 / (2.0f * kPi * d * d * masking) * fresnel;
}

vec3 GlossySurface::sample(float choice, vec2 u) const {
  if (choice >= lobeProbability_) return frame_.toWorld(sampleCosineHemisphere(u));
  const vec3 half = sampleVisibleNormal(eye_, alpha_, u);
  return frame_.toWorld(glm::normalize(2.0f * glm::dot(eye_, half) * half - eye_));
}

float GlossySurface::pdf(const vec3& w) const {
  const vec3 light = frame_.toLocal(w);
  if (light.z <= 0.0f) return 0.0f;
  const float a2 = alpha_ * alpha_, nv = eye_.z;
  const float d = arithmetic_ == LobeArithmetic::fromSine ? denominatorFromSine(light, eye_, a2)
                                                          : denominatorFromCosine(light, eye_, a2);
  const float lobe = visibleNormalPdf(nv, d, a2);
  return lobeProbability_ * lobe + (1.0f - lobeProbability_) * light.z / kPi;
}

}  // namespace lamplighter
