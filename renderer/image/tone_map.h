// Tone mapping: scene-referred radiance to display-referred pictures.
#pragma once

#include <cmath>
#include <span>
#include <string_view>

#include "renderer/image/image.h"
#include "shaders/shared/tone_curves.h"

namespace lamplighter {

enum class ToneMapper {
  linear = shared::kToneLinear,
  reinhard = shared::kToneReinhard,
  filmic = shared::kToneFilmic,
  hable = shared::kToneHable,
  agx = shared::kToneAgx
};

struct ToneMapperInfo {
  ToneMapper mapper;
  const char* name;   // as in actions
  const char* label;  // as in panels
  const char* help;   // one sentence
};
// In display order.
std::span<const ToneMapperInfo> toneMappers();
const ToneMapperInfo& infoOf(ToneMapper mapper);
// Throws InputError if the name is unknown.
const ToneMapperInfo& findToneMapper(std::string_view name);

// colour × 2^exposureEv, then the curve, then sRGB encoding (shaders/shared/tone_curves.h).
Image8 toneMap(const Image& radiance, float exposureEv, ToneMapper mapper = ToneMapper::filmic);
using shared::encodeSrgb;
// The inverse of encodeSrgb().
inline float decodeSrgb(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}
vec3 toneMapPixel(const vec3& radiance, float exposureEv, ToneMapper mapper = ToneMapper::filmic);

}  // namespace lamplighter
