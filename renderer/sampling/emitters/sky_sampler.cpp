#include "renderer/sampling/emitters/sky_sampler.h"

#include <algorithm>
#include <cmath>

#include "renderer/base/random.h"

namespace lamplighter {

namespace {

vec3 turnedAboutY(const vec3& d, float angle) {
  const float s = std::sin(angle), c = std::cos(angle);
  return {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
}

// Samples the height y of a direction of a gradient sky by luminance. The luminance is constant
// below the horizon and linear in y above, so the cumulative distribution is quadratic. It is a
// density over y; equal intervals of y have equal solid angles 2π dy.
struct GradientHeight {
  explicit GradientHeight(const Sky& sky)
      : ground(luminance(sky.ground)), a(luminance(sky.horizon)), b(luminance(sky.zenith)) {}
  float total() const { return ground + 0.5f * (a + b); }

  float sample(float u) const {
    float m = u * total();
    if (m < ground) return std::min(m / ground - 1.0f, -0x1p-24f);
    m -= ground;
    // Solves a y + (b − a) y²/2 = m in the form without cancellation.
    const float root = std::sqrt(std::max(0.0f, a * a + 2.0f * (b - a) * m));
    return a + root > 0.0f ? std::clamp(2.0f * m / (a + root), 0.0f, 1.0f) : 0.0f;
  }
  float density(float y) const { return (y < 0.0f ? ground : a + y * (b - a)) / total(); }

  float ground, a, b;
};

vec3 directionAt(float y, float u) {
  const float r = std::sqrt(std::max(0.0f, 1.0f - y * y)), azimuth = 2.0f * kPi * u;
  return {r * std::cos(azimuth), y, r * std::sin(azimuth)};
}

}  // namespace

vec3 SkySampler::turned(const vec3& d) const { return turnedAboutY(d, sky_.rotation); }
vec3 SkySampler::unturned(const vec3& d) const { return turnedAboutY(d, -sky_.rotation); }

vec3 SkySampler::irradiance() const {
  switch (sky_.kind) {
    case SkyKind::constant:
      return 4.0f * kPi * sky_.radiance;
    case SkyKind::gradient:
      return 2.0f * kPi * (sky_.ground + 0.5f * (sky_.horizon + sky_.zenith));
    case SkyKind::image:
      break;
  }
  return sky_.scale * sky_.image->map.irradiance();
}

SkyMap::Light SkySampler::sample(vec2 u) const {
  switch (sky_.kind) {
    case SkyKind::constant:
      return {sampleSphere(u), irradiance()};
    case SkyKind::gradient: {
      const GradientHeight height(sky_);
      const vec3 towards = directionAt(height.sample(u.y), u.x);
      const vec3 radiance = sky_.radianceFrom(towards);
      const float l = luminance(radiance);
      return {towards, l > 0.0f ? radiance * (2.0f * kPi * height.total() / l) : vec3(0.0f)};
    }
    case SkyKind::image:
      break;
  }
  const SkyMap::Light light = sky_.image->map.sample(u);
  return {turned(light.towards), sky_.scale * light.irradiance};
}

size_t SkySampler::sunCount() const {
  return sky_.kind == SkyKind::image ? sky_.image->map.suns().size() : 0;
}

SkyMap::Light SkySampler::sun(size_t i) const {
  const SkyMap::Light& mean = sky_.image->map.suns()[i].mean;
  return {turned(mean.towards), sky_.scale * mean.irradiance};
}

SkyMap::Light SkySampler::sun(size_t i, vec2 u) const {
  SkyMap::Light light = sun(i);
  light.towards = turned(sky_.image->map.suns()[i].direction(u));
  return light;
}

vec3 SkySampler::withoutSuns(const vec3& towards) const {
  // Cosine of 2.2°: the sky so near a sun counts as part of it (SkyMap::suns()).
  constexpr float kSunCosine = 0.99926f;
  for (size_t i = 0; i < sunCount(); ++i)
    if (glm::dot(sun(i).towards, towards) > kSunCosine) return vec3(0.0f);
  return radiance(towards);
}

SkyMap::Direction SkySampler::sampleDensity(vec2 u) const {
  if (sky_.kind == SkyKind::constant) return {sampleSphere(u), 1.0f / (4.0f * kPi)};
  if (sky_.kind == SkyKind::image) {
    const SkyMap::Direction d = sky_.image->map.sampleDensity(u);
    return {turned(d.towards), d.pdf};
  }
  const vec3 towards = directionAt(GradientHeight(sky_).sample(u.y), u.x);
  return {towards, density(towards)};
}

float SkySampler::density(const vec3& towards) const {
  if (sky_.kind == SkyKind::constant) return 1.0f / (4.0f * kPi);
  if (sky_.kind == SkyKind::image) return sky_.image->map.density(unturned(towards));
  return GradientHeight(sky_).density(towards.y) / (2.0f * kPi);
}

}  // namespace lamplighter
