// The reflection of one VPL by a surface's lobe towards the eye. Both backends follow this
// definition, like vpl_shading.h for irradiance.
#ifndef LAMPLIGHTER_SHARED_VPL_SPECULARS_H
#define LAMPLIGHTER_SHARED_VPL_SPECULARS_H
#include "brdf.h"
#include "vpl.h"

SHARED_BEGIN

// a hemisphere, the largest solid angle of a surface
SHARED_CONST float kMostSolidAngle = 6.28318531f;

// The solid angle [sr] that the VPL represents, seen from the point VPL + v.
SHARED_FUNCTION float vplSolidAngle(Vpl vpl, vec3 v, float clampDistance) {
  if (vpl.position.w == kVplDirectional) return vpl.footprint.x;
  if (vpl.position.w != kVplCosine) return 0.0f;
  float d2 = max(dot(v, v), 1e-12f);
  float z = max(dot(v, vec3(vpl.normal)), 0.0f);
  return vpl.footprint.x * z / (sqrt(d2) * max(d2, clampDistance * clampDistance));
}

// Radiance towards the eye for intensity 1, without shadow. geometry: from vplGeometry; ns: the
// shading normal; toEye: unit vector. The solid angle of a VPL is at most a hemisphere.
SHARED_FUNCTION vec3 vplSpecular(Vpl vpl, Lobe lobe, vec3 x, vec3 ns, vec3 toEye, float geometry,
                                 float clampDistance) {
  if (geometry <= 0.0f) return vec3(0.0f);
  vec3 v = x - vec3(vpl.position);
  float d = sqrt(max(dot(v, v), 1e-12f));
  vec3 l = vpl.position.w == kVplDirectional ? vec3(vpl.normal) : v * (-1.0f / d);
  float angle = vplSolidAngle(vpl, v, clampDistance);
  float share = geometry * min(1.0f, kMostSolidAngle / max(angle, 1e-6f));
  return share * lobeTowards(lobe, dot(ns, l), dot(l, toEye), angle);
}

SHARED_END
#endif
