#include "renderer/image/tone_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "renderer/base/error.h"

namespace lamplighter {

namespace {

constexpr std::array kMappers = {
    ToneMapperInfo{ToneMapper::linear, "linear", "Linear",
                   "No curve: what is over 1 is white. For judging values."},
    ToneMapperInfo{ToneMapper::reinhard, "reinhard", "Reinhard",
                   "By luminance, so that hues stay; white at 4 (Reinhard et al. 2002)."},
    ToneMapperInfo{ToneMapper::filmic, "filmic", "Filmic",
                   "A fit of the Academy's curve (Narkowicz 2016)."},
    ToneMapperInfo{ToneMapper::hable, "hable", "Hable",
                   "Filmic with a long shoulder, white at 11.2 (Hable 2010)."},
    ToneMapperInfo{ToneMapper::agx, "agx", "AgX",
                   "Bright colours fade to white without a turn of hue (Sobotka 2022, a fit)."},
};

// The filmic curve of K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016), a fit of the Academy's
// curve.
float filmic(float x) {
  return std::clamp(x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f), 0.0f, 1.0f);
}

constexpr float kMost = 1e4f;  // exposed radiance above which everything is white

// Infinite radiance is white. NaN is black, so that it is noticed in a lit picture.
float channel(float radiance, float scale) {
  const float x = radiance * scale;
  if (std::isnan(x)) return 0.0f;
  return encodeSrgb(x > kMost ? 1.0f : filmic(std::max(x, 0.0f)));
}

// Reinhard et al., "Photographic Tone Reproduction for Digital Images" (2002), eq. 4, applied to
// luminance.
vec3 reinhard(const vec3& x) {
  constexpr float kWhite = 4.0f;
  const float l = luminance(x);
  return x * ((1.0f + l / (kWhite * kWhite)) / (1.0f + l));
}

// J. Hable, "Uncharted 2: HDR Lighting" (GDC 2010): his curve with the constants of the talk.
vec3 hable(const vec3& x) {
  const auto curve = [](const vec3& v) {
    constexpr float a = 0.15f, b = 0.50f, c = 0.10f, d = 0.20f, e = 0.02f, f = 0.30f;
    return (v * (a * v + c * b) + d * e) / (v * (a * v + b) + d * f) - e / f;
  };
  constexpr float kExposure = 2.0f, kWhite = 11.2f;
  return curve(kExposure * x) / curve(vec3(kWhite));
}

// T. Sobotka's AgX (2022): transforms to less saturated primaries, applies a sigmoid to the
// logarithm, and transforms back. The sigmoid is the polynomial fit of B. Wrensch, "Minimal AgX
// Implementation" (2023). The result is display-referred, encoded with a power of 2.2.
vec3 agx(const vec3& x) {
  const mat3 inset(0.842479062f, 0.0423282423f, 0.0423756549f, 0.0784336f, 0.878468636f, 0.0784336f,
                   0.0792237451f, 0.0791661275f, 0.879142974f);
  const mat3 outset(1.19687901f, -0.0528968518f, -0.0529716355f, -0.0980208811f, 1.15190313f,
                    -0.0980434501f, -0.0990297441f, -0.0989611768f, 1.15107367f);
  constexpr float kLowest = -12.47393f, kHighest = 4.026069f;  // [EV]
  const vec3 stops = glm::log2(glm::max(inset * x, vec3(1e-10f)));
  const vec3 t = glm::clamp((stops - kLowest) / (kHighest - kLowest), 0.0f, 1.0f);
  const vec3 t2 = t * t, t4 = t2 * t2;
  const vec3 curve = 15.5f * t4 * t2 - 40.14f * t4 * t + 31.96f * t4 - 6.868f * t2 * t +
                     0.4298f * t2 + 0.1191f * t - 0.00232f;
  return outset * curve;
}

vec3 mapped(const vec3& radiance, float scale, ToneMapper mapper) {
  if (mapper == ToneMapper::filmic)
    return {channel(radiance.r, scale), channel(radiance.g, scale), channel(radiance.b, scale)};
  const vec3 x = radiance * scale;
  vec3 bounded;
  for (int c = 0; c < 3; ++c) bounded[c] = std::isnan(x[c]) ? 0.0f : std::clamp(x[c], 0.0f, kMost);
  vec3 shown = bounded;
  if (mapper == ToneMapper::reinhard) shown = reinhard(bounded);
  if (mapper == ToneMapper::hable) shown = hable(bounded);
  if (mapper == ToneMapper::agx) shown = agx(bounded);
  for (int c = 0; c < 3; ++c) {
    shown[c] = std::clamp(shown[c], 0.0f, 1.0f);
    if (mapper != ToneMapper::agx) shown[c] = encodeSrgb(shown[c]);
    if (x[c] > kMost) shown[c] = 1.0f;
    if (std::isnan(x[c])) shown[c] = 0.0f;
  }
  return shown;
}

}  // namespace

std::span<const ToneMapperInfo> toneMappers() { return kMappers; }

const ToneMapperInfo& infoOf(ToneMapper mapper) {
  return *std::find_if(kMappers.begin(), kMappers.end(),
                       [&](const ToneMapperInfo& m) { return m.mapper == mapper; });
}

const ToneMapperInfo& findToneMapper(std::string_view name) {
  const auto found = std::find_if(kMappers.begin(), kMappers.end(),
                                  [&](const ToneMapperInfo& m) { return m.name == name; });
  if (found != kMappers.end()) return *found;
  std::string names;
  for (const ToneMapperInfo& m : kMappers)
    names += (names.empty() ? "" : ", ") + std::string(m.name);
  throw InputError("tone mapper", "'" + std::string(name) + "' is none", "give one of " + names);
}

float encodeSrgb(float v) {
  if (v >= 1.0f) return 1.0f;  // the formula would be one bit below 1
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1.0f / 2.4f) - 0.055f;
}

vec3 toneMapPixel(const vec3& radiance, float exposureEv, ToneMapper mapper) {
  return mapped(radiance, std::exp2(exposureEv), mapper);
}

Image8 toneMap(const Image& radiance, float exposureEv, ToneMapper mapper) {
  Image8 out(radiance.width, radiance.height);
  const float scale = std::exp2(exposureEv);
  for (size_t i = 0; i < radiance.pixels.size(); ++i) {
    const vec3 shown = mapped(radiance.pixels[i], scale, mapper);
    for (int c = 0; c < 3; ++c)
      out.pixels[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(shown[c] * 255.0f + 0.5f);
  }
  return out;
}

}  // namespace lamplighter
