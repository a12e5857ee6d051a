// The G-buffer's shading normals as vectors, zero where nothing was hit: for read-back and debug
// views.
#include "common/normal_packing.glsl"
#include "shared/bindings.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;

layout(location = 0) out vec4 outNormal;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  bool hit = texelFetch(uPosition, pixel, 0).w != 0.0;
  outNormal = vec4(hit ? unpackNormal(texelFetch(uNormals, pixel, 0).xy) : vec3(0.0), 1.0);
}
