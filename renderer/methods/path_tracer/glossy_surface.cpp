#include "renderer/methods/path_tracer/glossy_surface.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/random.h"

namespace lamplighter {
namespace {

// The density of directions from sampleVisibleNormal() per solid angle: D·G1 / (4 n·v).
float visibleNormalPdf(float nv, float nh2, float alpha) {
  const float a2 = alpha * alpha, d = nh2 * (a2 - 1.0f) + 1.0f;
  const float distribution = a2 / (kPi * d * d);
  return distribution / (2.0f * (nv + std::sqrt(nv * nv * (1.0f - a2) + a2)));
}

}  // namespace

GlossySurface::GlossySurface(const vec3& baseColor, const Gloss& gloss, float leastRoughness,
                             const vec3& normal, const vec3& toEye)
    : frame_(normal), eye_(frame_.toLocal(toEye)) {
  const float nv = std::max(eye_.z, shared::kLeastCosine);
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
  return diffuse_ + shared::lobeTowards(lobe_, light.z, glm::dot(light, eye_), 0.0f);
}

vec3 GlossySurface::sample(float choice, vec2 u) const {
  if (choice >= lobeProbability_) return frame_.toWorld(sampleCosineHemisphere(u));
  const vec3 half = sampleVisibleNormal(eye_, alpha_, u);
  return frame_.toWorld(glm::normalize(2.0f * glm::dot(eye_, half) * half - eye_));
}

float GlossySurface::pdf(const vec3& w) const {
  const vec3 light = frame_.toLocal(w);
  if (light.z <= 0.0f) return 0.0f;
  const vec3 half = glm::normalize(light + eye_);
  const float lobe = visibleNormalPdf(std::max(eye_.z, 1e-4f), half.z * half.z, alpha_);
  return lobeProbability_ * lobe + (1.0f - lobeProbability_) * light.z / kPi;
}

}  // namespace lamplighter
