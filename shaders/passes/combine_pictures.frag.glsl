// One picture of another, or of two: MULTIPLY, SUBTRACT or AVERAGE is defined.
#include "shared/bindings.h"

layout(binding = kPicture) uniform sampler2D uPicture;
layout(binding = kOtherPicture) uniform sampler2D uOther;
layout(location = 0) uniform int uBlock;  // AVERAGE: pixels per side

layout(location = 0) out vec4 outPicture;

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
#if defined(MULTIPLY)
  outPicture = vec4(texelFetch(uPicture, at, 0).rgb * texelFetch(uOther, at, 0).rgb, 1.0);
#elif defined(SUBTRACT)
  outPicture = vec4(texelFetch(uPicture, at, 0).rgb - texelFetch(uOther, at, 0).rgb, 1.0);
#else
  vec3 sum = vec3(0.0);
  for (int y = 0; y < uBlock; ++y)
    for (int x = 0; x < uBlock; ++x) sum += texelFetch(uPicture, at * uBlock + ivec2(x, y), 0).rgb;
  outPicture = vec4(sum / float(uBlock * uBlock), 1.0);
#endif
}
