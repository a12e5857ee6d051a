// From scene-referred radiance to a picture on a display.
#pragma once

#include <cmath>
#include <span>
#include <string_view>

#include "renderer/image/image.h"

namespace lamplighter {

enum class ToneMapper { linear, reinhard, filmic, hable, agx };

struct ToneMapperInfo {
  ToneMapper mapper;
  const char* name;   // as in actions
  const char* label;  // as in panels
  const char* help;   // one sentence
};
// In the order they are shown.
std::span<const ToneMapperInfo> toneMappers();
const ToneMapperInfo& infoOf(ToneMapper mapper);
// Throws InputError when there is none of that name.
const ToneMapperInfo& findToneMapper(std::string_view name);

// colour × 2^exposureEv, then the curve, then sRGB encoding. shaders/passes/tone_map.glsl does the
// same on the GPU.
Image8 toneMap(const Image& radiance, float exposureEv, ToneMapper mapper = ToneMapper::filmic);
// The sRGB encoding of a linear value; 1 and more is 1.
float encodeSrgb(float v);
// And back.
inline float decodeSrgb(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}
vec3 toneMapPixel(const vec3& radiance, float exposureEv, ToneMapper mapper = ToneMapper::filmic);

}  // namespace lamplighter
