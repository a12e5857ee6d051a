// Adds the light of some VPLs of one kind, whose maps lie in one array, to the irradiance of each
// pixel of the G-buffer. It is read and written instead of blended, so that the order of additions,
// and with it each bit, does not depend on how many VPLs one draw takes.
//   without PATCHES: the same VPLs at every pixel, with their maps;
//   with PATCHES: those that its place's list names, as it says (paper 1, 4.3.4).
#include "common/normal_packing.glsl"
#include "common/vpls.glsl"
#include "shared/patches.h"
#include "shared/shadow_depth.h"
#include "shared/vpl_shading.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kShadowMaps) uniform sampler2DArray uMaps;
layout(binding = kIrradiance) uniform sampler2D uIrradiance;

layout(location = 0) uniform int uFirst;  // in uVpls, or in each list
layout(location = 1) uniform int uEnd;
layout(location = 2) uniform vec4 uClampAndBias;  // ShadingParams

#ifdef PATCHES
layout(binding = kPlaces) uniform usampler2D uPlaces;
// By place: x: where the list begins, y: how many of it need no map, and above bit 16 those that
// come after and do.
layout(std430, binding = kListRangeBuffer) readonly buffer Ranges { uvec2 ranges[]; };
layout(std430, binding = kListBuffer) readonly buffer Entries { uint entries[]; };
layout(location = 3) uniform int uFirstRange;  // of these VPLs
layout(location = 4) uniform int uFirstVpl;    // in uVpls, that the lists call 0
#endif

layout(location = 0) out vec4 outIrradiance;

struct Point {
  vec3 position, shading, geometric;
};

bool occluded(Vpl vpl, vec3 x, vec3 normal) {
  float bias = uClampAndBias.y, resolution = uClampAndBias.z;
  vec3 q = vplToLight(vpl, x - vpl.position.xyz);
  vec3 n = vplToLight(vpl, normal);
#ifdef DIRECTIONAL
  vec2 s = directionalEncode(vpl, q);
#else
  vec2 s = octahedralEncode(q);
#endif
  vec2 texel = shadowTexel(s, resolution);
  vec2 centre = shadowTexelCentre(texel, resolution);
  float depth = texelFetch(uMaps, ivec3(texel, int(vpl.intensity.w)), 0).r;
#ifdef DIRECTIONAL
  return directionalOccluded(vpl, depth, q, n, centre, bias);
#else
  return hemisphereOccluded(depth * (1.0 / kShadowDepthUnit), q, n, centre, bias, resolution);
#endif
}

Vpl vplAt(int i) {
  Vpl vpl = uVpls[i];
  vpl.position.w = VPL_KIND;  // known to the compiler, which drops the other kinds
  return vpl;
}

float geometryOf(Vpl vpl, Point x) {
  return vplGeometry(vpl, x.position, x.shading, x.geometric, uClampAndBias.x);
}

#ifdef PATCHES
vec3 withListOf(uint place, Point x, vec3 sum) {
  uvec2 range = ranges[uFirstRange + int(place)];
  int plain = int(range.y & 65535u);
  int all = plain + int(range.y >> 16);
  for (int i = uFirst; i < min(uEnd, plain); ++i) {
    Vpl vpl = vplAt(uFirstVpl + int(entries[range.x + uint(i)]));
    sum += geometryOf(vpl, x) * vpl.intensity.rgb;
  }
  for (int i = max(uFirst, plain); i < min(uEnd, all); ++i) {
    int entry = int(entries[range.x + uint(i)]);
    bool takes = entry >= kTakeShadow;
    Vpl vpl = vplAt(uFirstVpl + (takes ? entry - kTakeShadow : entry));
    float g = geometryOf(vpl, x);
    if (g > 0.0 && occluded(vpl, x.position, x.geometric) == takes) {
      sum += (takes ? -g : g) * vpl.intensity.rgb;
    }
  }
  return sum;
}
#else
vec3 withAll(Point x, vec3 sum) {
  for (int i = uFirst; i < uEnd; ++i) {
    Vpl vpl = vplAt(i);
    float g = geometryOf(vpl, x);
    if (g > 0.0 && !(vpl.intensity.w >= 0.0 && occluded(vpl, x.position, x.geometric))) {
      sum += g * vpl.intensity.rgb;
    }
  }
  return sum;
}
#endif

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 position = texelFetch(uPosition, pixel, 0);
  if (position.w == 0.0) discard;
  vec4 normals = texelFetch(uNormals, pixel, 0);
  Point x = Point(position.xyz, unpackNormal(normals.xy), unpackNormal(normals.zw));
  vec3 sum = texelFetch(uIrradiance, pixel, 0).rgb;
#ifdef PATCHES
  outIrradiance = vec4(withListOf(texelFetch(uPlaces, pixel, 0).r, x, sum), 0.0);
#else
  outIrradiance = vec4(withAll(x, sum), 0.0);
#endif
}
