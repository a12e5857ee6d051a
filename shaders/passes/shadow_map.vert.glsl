// Occluders into the map of one VPL; see shaders/shared/octahedral.h for the projection. A face of
// the octahedron at a time: there |x| and |y| are uFace.x·x and uFace.y·y, so that everything is
// linear and rasterises exactly. All faces share one viewport; clip planes keep them apart.
#include "common/vpls.glsl"
#include "shared/shadow_depth.h"
#include "shared/vpl_shading.h"

layout(location = kPositionAttribute) in vec3 inPosition;
#ifdef ALPHA_MASK
layout(location = kUv0Attribute) in vec2 inUv0;
layout(location = kUv1Attribute) in vec2 inUv1;
layout(location = kColorAttribute) in vec4 inColor;
layout(location = 0) out vec2 vUv0;
layout(location = 1) out vec2 vUv1;
layout(location = 2) out float vAlpha;
#endif

layout(location = 0) uniform int uVpl;
layout(location = 1) uniform vec2 uFace;  // signs of x and y
// How far a face reaches over its creases, as a share of w: a hundredth of a texel, since rounding
// must not let a texel centre on the crease fall between two faces.
layout(location = 2) uniform float uCrease;
layout(location = 3) uniform float uNear;  // least w [m]: past the surface that the VPL lies on

out float gl_ClipDistance[4];

void main() {
  Vpl vpl = uVpls[uVpl];
  vec3 q = vplToLight(vpl, inPosition - vpl.position.xyz);
#ifdef DIRECTIONAL
  vec2 s = directionalEncode(vpl, q);
  gl_Position = vec4(s, 0.5 + 0.5 * q.z / vpl.normal.w, 1.0);
  for (int i = 0; i < 4; ++i) gl_ClipDistance[i] = 1.0;
#else
  vec2 a = q.xy * uFace;
  float w = a.x + a.y + q.z;
  gl_Position = vec4(q.x + q.y, q.x - q.y, kShadowDepthUnit, w);
  gl_ClipDistance[0] = a.x + uCrease * w;
  gl_ClipDistance[1] = a.y + uCrease * w;
  gl_ClipDistance[2] = q.z;
  gl_ClipDistance[3] = w - uNear;
#endif
#ifdef ALPHA_MASK
  vUv0 = inUv0;
  vUv1 = inUv1;
  vAlpha = inColor.a;
#endif
}
