// The BRDF of surfaces seen by the eye: metallic-roughness of glTF 2.0, appendix B (GGX,
// height-correlated Smith masking, Schlick's Fresnel), for light from one direction. Only the last
// surface before the eye uses it, or all of a path with glossy_bounces; others are Lambertian.
//   f = ρ/π · diffuseShare + D·V·F
// Two differences from appendix B:
//   - The diffuse part is reduced by the directional albedo of the lobe for the eye's direction
//     (diffuseShare), not by the Fresnel term of each light's direction. So irradiance can be
//     summed without knowing its directions, and a white surface at a grazing angle does not
//     reflect more than it receives (with appendix B: 1.4 times as much at roughness 0.3). The
//     disadvantage: the diffuse part is not reciprocal; the lobe is.
//   - The lobe of a dielectric fades out between the roughness kDull and 1. A very rough non-metal
//     is exactly Lambertian; this changes it by about two hundredths of the light.
#ifndef LAMPLIGHTER_SHARED_BRDF_H
#define LAMPLIGHTER_SHARED_BRDF_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST float kDull = 0.9f;
// F0 of a dielectric with refractive index 1.5.
SHARED_CONST float kDielectric = 0.04f;
// Lower bound of the cosine at the eye. It avoids division by zero where normal maps or smoothed
// normals face away from the eye.
SHARED_CONST float kLeastCosine = 0.01f;

// The lobe at a point, prepared for many lights.
struct Lobe {
  vec4 straight;  // rgb: F0; w: F at 90°
  vec4 shape;     // x: α² (α = roughness²); y: n·v ≥ kLeastCosine; zw: 0
};

SHARED_FUNCTION float dielectricShare(float roughness) {
  return clamp((1.0f - roughness) * (1.0f / (1.0f - kDull)), 0.0f, 1.0f);
}

// Whether a material has a lobe.
SHARED_FUNCTION bool isGlossy(float metallic, float roughness) {
  return metallic > 0.0f || roughness < 1.0f;
}

// nv: n·v for the direction v towards the eye; least: lower bound of the roughness.
SHARED_FUNCTION Lobe makeLobe(vec3 baseColor, float metallic, float roughness, float least,
                              float nv) {
  float share = dielectricShare(roughness) * (1.0f - metallic);
  float alpha = max(roughness, least) * max(roughness, least);
  Lobe lobe;
  lobe.straight = vec4(metallic * baseColor + vec3(kDielectric * share), metallic + share);
  lobe.shape = vec4(alpha * alpha, max(nv, kLeastCosine), 0.0f, 0.0f);
  return lobe;
}

// The directional albedo of a dielectric's lobe: a fit to the integral with an error of at most
// 0.03, for roughness from 0.1.
SHARED_FUNCTION float dielectricAlbedo(float roughness, float least, float nv) {
  float r = max(roughness, least), r2 = r * r;
  float away = 1.0f - clamp(nv, kLeastCosine, 1.0f);  // nv may be above 1 by rounding
  return kDielectric * (1.0f - r2 * r) +
         0.96f / (1.0f + 14.9f * r2 + 1.2f * r2 * r2) * pow(away, 5.0f - 9.42f * r + 7.85f * r2);
}

// The factor of the albedo for the diffuse part.
SHARED_FUNCTION float diffuseShare(float metallic, float roughness, float least, float nv) {
  if (!isGlossy(metallic, roughness)) return 1.0f;
  return (1.0f - metallic) *
         (1.0f - dielectricShare(roughness) * dielectricAlbedo(roughness, least, nv));
}

// Widens the lobe for a light sample that represents a solid angle Ω of light, so that the sample
// does not appear as a bright spot. In the lobe, half vectors within Ω / (4 v·h) reflect it (Walter
// et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equation 14). The lobe
// covers an area of about π α² of half vectors; it grows by kSpread times that solid angle:
//   α'² = α² + kSpread · Ω / (4π v·h)
// Karis ("Real Shading in Unreal Engine 4", 2013) widens it in the same way by the angle of an area
// light; an alternative is gathering over a sphere around the sample (Hašan et al., "Virtual
// Spherical Lights for Many-Light Rendering of Glossy Scenes", 2009). D is at most 1/(π α'²), so
// where the half vector is near the normal, the highlight of one sample is at most 1/kSpread of its
// mirror image, F times its light: the visible highlight comes from several samples. With kSpread
// 1, single samples exceed their sum by 60% in the test. The price: highlights are softer by the
// angle between samples, and darker where it is large; at roughness 0.25 by 1% at 0.03 sr, 4% at
// 0.08 sr, 17% at 0.3 sr. Both effects vanish as the number of samples grows.
SHARED_CONST float kSpread = 4.0f;
SHARED_FUNCTION float widened(float alpha2, float solidAngle, float vh) {
  return min(alpha2 + kSpread * 0.0795774715f * solidAngle / vh, 1.0f);
}

// D·V·F at the normal n for light from l, seen from v (all unit vectors), not multiplied by n·l.
// solidAngle: represented by the light [sr]; 0 for a point. 0 where n·l ≤ 0.
SHARED_FUNCTION vec3 lobeTowards(Lobe lobe, float nl, float lv, float solidAngle) {
  if (nl <= 0.0f) return vec3(0.0f);
  float nv = lobe.shape.y;
  // h = (l + v) / |l + v|, |l + v|² = 2 + 2 l·v.
  float vh2 = max(0.5f + 0.5f * lv, 1e-6f), vh = sqrt(vh2);
  float a2 = widened(lobe.shape.x, solidAngle, vh);
  float nh2 = min((nl + nv) * (nl + nv) / (4.0f * vh2), 1.0f);
  float d = nh2 * (a2 - 1.0f) + 1.0f;
  float masking = nl * sqrt(nv * nv * (1.0f - a2) + a2) + nv * sqrt(nl * nl * (1.0f - a2) + a2);
  float dv = a2 * 0.159154943f / (d * d * masking);
  float m = 1.0f - vh, m2 = m * m;
  float grazing = m2 * m2 * m;
  vec3 straight = vec3(lobe.straight);
  return dv * (straight + grazing * (vec3(lobe.straight.w) - straight));
}

SHARED_END
#endif
