// Adds the light of some VPLs of one kind, whose maps lie in one array, to the irradiance of each
// G-buffer pixel. It reads and writes the sum instead of blending, so that the order of additions,
// and so each bit, does not depend on the number of VPLs per draw.
//   without PATCHES: the same VPLs at every pixel, with their maps;
//   with LINKS in addition: except those that light linking excludes;
//   with PATCHES: the VPLs in the list of the pixel's place (paper 1, 4.3.4);
//   with MERGED in addition: of these, the part that uPass selects (paper 1, 4.3.5).
#include "common/normal_packing.glsl"
#include "common/shadow_look_up.glsl"
#include "common/vpls.glsl"
#include "shared/patches.h"
#include "shared/vpl_shading.h"
#ifdef LINKS
#include "common/left_out.glsl"
#endif

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(binding = kIrradiance) uniform sampler2D uIrradiance;

layout(location = 0) uniform int uFirst;  // index into uVpls, or into each list
layout(location = 1) uniform int uEnd;
layout(location = 2) uniform vec4 uClampAndBias;  // ShadingParams

#ifdef PATCHES
layout(binding = kPlaces) uniform usampler2D uPlaces;
// By place. x: index of the first entry; y: the number of entries without a map look-up, and from
// bit 16 on the number of those with one, which follow.
layout(std430, binding = kListRangeBuffer) readonly buffer Ranges { uvec2 ranges[]; };
layout(std430, binding = kListBuffer) readonly buffer Entries { uint entries[]; };
layout(location = 3) uniform int uFirstRange;  // of these VPLs
layout(location = 4) uniform int uFirstVpl;    // index in uVpls of entry value 0
#ifdef MERGED
// 0: entries uFirst to uEnd of those without a map look-up; else those of merged pass uPass − 1.
layout(location = 5) uniform int uPass;
#endif
#endif

layout(location = 0) out vec4 outIrradiance;

struct Point {
  vec3 position, shading, geometric;
#ifdef LINKS
  uint leftOutBy;
#endif
};

Vpl vplAt(int i) {
#ifdef PATCHES
  Vpl vpl = gatheredVpl(i);
#else
  Vpl vpl = uVpls[i];
#endif
  // a compile-time constant, so that the compiler removes the other kinds
  vpl.position.w = VPL_KIND;
  return vpl;
}

float geometryOf(Vpl vpl, Point x) {
  return vplGeometry(vpl, x.position, x.shading, x.geometric, uClampAndBias.x);
}

#ifdef PATCHES
// The part of a list to sum: [plain.x, plain.y) without a map look-up, [shadowed.x, shadowed.y)
// with one.
struct Part {
  uint list;
  ivec2 plain, shadowed;
};

#ifdef MERGED
// The first index in [low, high) whose pass is not less than `pass`.
int firstOfPass(uint list, int low, int high, uint pass) {
  while (low < high) {
    int middle = (low + high) / 2;
    if (entries[list + uint(middle)] / uint(kPassUnit) < pass)
      low = middle + 1;
    else
      high = middle;
  }
  return low;
}
#endif

Part partOf(uint place) {
  uvec2 range = ranges[uFirstRange + int(place)];
  int plain = int(range.y & 65535u);
  int all = plain + int(range.y >> 16);
#ifdef MERGED
  if (uPass == 0) return Part(range.x, ivec2(uFirst, min(uEnd, plain)), ivec2(0));
  uint pass = uint(uPass - 1);
  int first = firstOfPass(range.x, plain, all, pass);
  return Part(range.x, ivec2(0), ivec2(first, firstOfPass(range.x, first, all, pass + 1u)));
#else
  return Part(range.x, ivec2(uFirst, min(uEnd, plain)), ivec2(max(uFirst, plain), min(uEnd, all)));
#endif
}

vec3 withPart(Part part, Point x, vec3 sum) {
  for (int i = part.plain.x; i < part.plain.y; ++i) {
    Vpl vpl = vplAt(uFirstVpl + int(entries[part.list + uint(i)]));
    sum += geometryOf(vpl, x) * vpl.intensity.rgb;
  }
  for (int i = part.shadowed.x; i < part.shadowed.y; ++i) {
    uint stored = entries[part.list + uint(i)];
#ifdef MERGED
    stored %= uint(kPassUnit);
#endif
    int entry = int(stored);
    bool takes = entry >= kTakeShadow;
    Vpl vpl = vplAt(uFirstVpl + (takes ? entry - kTakeShadow : entry));
    float g = geometryOf(vpl, x);
    if (g > 0.0 && occluded(vpl, x.position, x.geometric, uClampAndBias) == takes) {
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
#ifdef LINKS
    if (isLeftOut(x.leftOutBy, vpl.footprint.y)) g = 0.0;
#endif
    if (g > 0.0 && !(vpl.slot >= 0 && occluded(vpl, x.position, x.geometric, uClampAndBias))) {
      sum += g * vpl.intensity.rgb;
    }
  }
  return sum;
}
#endif

void main() {
  ivec2 at = ivec2(gl_FragCoord.xy);
#ifdef PATCHES
  // A pixel without entries in this pass only pays for finding this out. Place 0 has an empty list.
  Part part = partOf(texelFetch(uPlaces, at, 0).r);
  if (part.plain.x >= part.plain.y && part.shadowed.x >= part.shadowed.y) discard;
#endif
  vec4 position = texelFetch(uPosition, at, 0);
  if (position.w == 0.0) discard;
  vec4 normals = texelFetch(uNormals, at, 0);
  Point x = Point(position.xyz, unpackNormal(normals.xy), unpackNormal(normals.zw)
#ifdef LINKS
                  , leftOutAt(position.w)
#endif
  );
  vec3 sum = texelFetch(uIrradiance, at, 0).rgb;
#ifdef PATCHES
  outIrradiance = vec4(withPart(part, x, sum), 0.0);
#else
  outIrradiance = vec4(withAll(x, sum), 0.0);
#endif
}
