// The light of one VPL at one point, and the shadow map look-up. Both backends follow this
// definition (gl includes it; cpu/ has a version for eight points at a time, which is tested
// against it).
//
// The shadow test compares in the plane of the receiver. A map stores one value per texel, that of
// its centre, but is read for all points of the texel. Along the receiver's own plane 1/w is linear
// on a face, so the value that the receiver itself would have at the centre is known exactly, and
// no slope bias is needed. A point is in shadow if the stored occluder is nearer than both
//   - the receiver's plane at the texel's centre; otherwise planes would shadow themselves (acne);
//   - the point itself, by the largest change over half a texel of a surface that crosses the ray;
//     otherwise the other wall of a concave corner, which the ray through the centre may hit just
//     above the point, would shadow it. On the octahedron's faces, which are up to √3 nearer than
//     its corners, half a texel is up to √3/resolution wide, and more where the wall is steep:
//     kCornerTexels. In the Cornell box this reduces the error of direct light with 64² maps from
//     4.1 to 2.2% (with 1: 2.4%, with 3: 2.2%), in the default scene from outside, compared with
//     rays, from 6.2 (with 1) to 4.8%. The price: shadows of objects that stand out by less than
//     kCornerTexels/resolution of the distance to the light, about the size of a texel there, are
//     lost.
// The remaining leaks and false shadows are one texel wide, at silhouettes.
#ifndef LAMPLIGHTER_SHARED_VPL_SHADING_H
#define LAMPLIGHTER_SHARED_VPL_SHADING_H
#include "interop.h"
#include "octahedral.h"
#include "vpl.h"

SHARED_BEGIN

SHARED_CONST float kCornerTexels = 2.0f;
SHARED_CONST float kSteepTexels = 4.0f;

// Column and row (integers as floats) of the texel that contains the square coordinates s in [-1,
// 1]². Row 0 is at t = −1; the index of the texel is row · resolution + column.
SHARED_FUNCTION vec2 shadowTexel(vec2 s, float resolution) {
  return clamp(floor((s * 0.5f + 0.5f) * resolution), vec2(0.0f), vec2(resolution - 1.0f));
}

// Square coordinates of a texel's centre: where the map was sampled.
SHARED_FUNCTION vec2 shadowTexelCentre(vec2 texel, float resolution) {
  return (texel + 0.5f) * (2.0f / resolution) - 1.0f;
}

// Transforms a world-space vector to the frame of the VPL.
SHARED_FUNCTION vec3 vplToLight(Vpl vpl, vec3 v) {
  vec3 n = vec3(vpl.normal);
  vec3 t = vec3(vpl.tangent);
  return vec3(dot(v, t), dot(v, cross(n, t)), dot(v, n));
}

// Hemisphere maps. stored: 1/w of the occluder [1/m], 0: none; q: the point, n: the normal of its
// plane on the lit side, both in light space; centre: of the texel that contains
// octahedralEncode(q). On the ray through e with w(e) = 1 the plane is at 1/w = (n·e)/(n·q). Both
// sides are multiplied by −n·q > 0 to avoid the division; where the plane misses that ray (−n·e ≤
// 0) its test does not apply.
SHARED_FUNCTION bool hemisphereOccluded(float stored, vec3 q, vec3 n, vec2 centre, float bias,
                                        float resolution) {
  vec3 e = octahedralDecode(centre);
  return stored * octahedralW(q) > 1.0f + bias + kCornerTexels / resolution &&
         stored * -dot(n, q) > (1.0f + bias) * -dot(n, e);
}

// Maps of directional VPLs: orthographic; [-1, 1]² is [-S, S]² along (tangent, bitangent) around
// the position. stored is (h + R) / 2R with h the occluder's height along the normal, so nearer to
// the light is larger here too; 0: none.
SHARED_FUNCTION vec2 directionalEncode(Vpl vpl, vec3 q) {
  return vec2(q.x, q.y) * (1.0f / vpl.tangent.w);
}

// bias is a share of S here. There is no corner tolerance: half a texel of a sky or sun map is
// larger than the thickness of roofs, which would leak. The tolerance of the plane does not apply
// to occluders that are more than kSteepTexels texel widths above the point: within half a texel
// the plane itself reaches that height only if light hits it at a grazing angle below 10°, and
// small steep faces below a roof would be lit through it.
SHARED_FUNCTION bool directionalOccluded(Vpl vpl, float stored, vec3 q, vec3 n, vec2 centre,
                                         float bias, float resolution) {
  float side = vpl.tangent.w;
  // Height of the occluder above the point, and above the receiver's plane at the centre (× n.z >
  // 0).
  float above = (2.0f * stored - 1.0f) * vpl.normal.w - bias * side - q.z;
  float dx = centre.x * side - q.x;
  float dy = centre.y * side - q.y;
  float steep = kSteepTexels * 2.0f / resolution * side;
  return above > 0.0f && (above > steep || above * n.z > -(n.x * dx + n.y * dy));
}

// E / I: irradiance at the point x for intensity 1, without shadow. ns: shading normal, ng:
// geometric normal, both on the visible side. 0 where the light is behind either normal.
// clampDistance bounds 1/d² of VPLs on surfaces; that of a punctual light is exact.
SHARED_FUNCTION float vplGeometry(Vpl vpl, vec3 x, vec3 ns, vec3 ng, float clampDistance) {
  vec3 axis = vec3(vpl.normal);
  vec3 v = x - vec3(vpl.position);
  if (vpl.position.w == kVplDirectional) {
    vec3 q = vplToLight(vpl, v);
    float side = vpl.tangent.w;
    if (q.x < -side || q.x >= side || q.y < -side || q.y >= side || dot(ng, axis) <= 0.0f) {
      return 0.0f;
    }
    return max(dot(ns, axis), 0.0f);
  }
  float z = dot(v, axis);
  float s = -dot(ns, v);
  if (z <= 0.0f || s <= 0.0f || -dot(ng, v) <= 0.0f) {
    return 0.0f;
  }
  float d2 = dot(v, v);
  if (vpl.position.w == kVplCosine) {
    // cos · cos / d² = (s/d)(z/d) / max(d², d0²)
    return s * z / (d2 * max(d2, clampDistance * clampDistance));
  }
  float d = sqrt(d2);
  float cone = min(max(z / d * vpl.normal.w + vpl.tangent.w, 0.0f), 1.0f);
  return cone * cone * s / (d2 * d);
}

SHARED_END
#endif
