// Draws occluders into the map of one VPL; shaders/shared/octahedral.h explains the projection. One
// face of the octahedron is drawn at a time: on it |x| and |y| equal uFace.x·x and uFace.y·y, so
// everything is linear and rasterises exactly. All faces share one viewport; clip planes separate
// them.
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
// How far a face extends past its creases, as a share of w: a hundredth of a texel. Without it,
// rounding could leave a texel centre on the crease between two faces.
layout(location = 2) uniform float uCrease;
layout(location = 3) uniform float uNear;  // smallest w [m]: skips the surface that the VPL lies on

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
