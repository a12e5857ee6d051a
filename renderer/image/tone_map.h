// From scene-referred radiance to a picture on a display.
#pragma once

#include "renderer/image/image.h"

namespace lamplighter {

// colour × 2^exposureEv, then the filmic curve, then sRGB encoding. shaders/passes/tone_map.glsl
// does the same on the GPU.
Image8 toneMap(const Image& radiance, float exposureEv);
// The sRGB encoding of a linear value; 1 and more is 1.
float encodeSrgb(float v);
vec3 toneMapPixel(const vec3& radiance, float exposureEv);

}  // namespace lamplighter
