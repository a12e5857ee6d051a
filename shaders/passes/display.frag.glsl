// The tone-mapped picture, pixel by pixel.
#include "shared/tone_curves.h"

layout(binding = 0) uniform sampler2D uRadiance;
layout(location = 0) uniform float uScale;  // 2^exposure
layout(location = 1) uniform int uMapper;   // ToneMapper
layout(location = 0) out vec4 outColour;

void main() {
  vec3 radiance = texelFetch(uRadiance, ivec2(gl_FragCoord.xy), 0).rgb;
  outColour = vec4(toneMap(radiance, uScale, uMapper), 1.0);
}
