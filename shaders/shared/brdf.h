// What the eye sees of a material: the metallic-roughness BRDF of glTF 2.0, appendix B (GGX,
// height- correlated Smith masking, Schlick's Fresnel), for light of one direction. Light that
// bounces on is reflected as Lambert's, with the base colour; only the last surface before the eye
// has this.
//   f = ρ/π · diffuseShare + D·V·F
// Two things differ from appendix B:
//   - The diffuse part is held back by what the lobe reflects of the eye's direction as a whole
//     (diffuseShare) instead of by the Fresnel term of each light's direction: irradiance can then
//     be summed as ever, without knowing where it comes from, and a white surface seen at a grazing
//     angle does not give back more than it gets, which it does by appendix B (1.4 times as much at
//     roughness 0.3). The price: it is not reciprocal; the lobe is.
//   - A dielectric's lobe fades out between the roughness kDull and 1. What is quite rough and no
//     metal is Lambert's, to the bit: it would be by about two hundredths of the light otherwise.
#ifndef LAMPLIGHTER_SHARED_BRDF_H
#define LAMPLIGHTER_SHARED_BRDF_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST float kDull = 0.9f;
// Of a dielectric of refractive index 1.5, seen straight on.
SHARED_CONST float kDielectric = 0.04f;
// No cosine at the eye is less, so that normal maps and smoothed normals that look away from it do
// not divide by nothing.
SHARED_CONST float kLeastCosine = 0.01f;

// The lobe at a point, ready for many lights.
struct Lobe {
  vec4 straight;  // rgb: F0; w: F at 90°
  vec4 shape;     // x: α² (α = roughness²); y: n·v ≥ kLeastCosine; zw: 0
};

SHARED_FUNCTION float dielectricShare(float roughness) {
  return clamp((1.0f - roughness) * (1.0f / (1.0f - kDull)), 0.0f, 1.0f);
}

// Whether a material has a lobe at all.
SHARED_FUNCTION bool isGlossy(float metallic, float roughness) {
  return metallic > 0.0f || roughness < 1.0f;
}

// nv: n·v of the direction towards the eye; least: roughness below which none goes.
SHARED_FUNCTION Lobe makeLobe(vec3 baseColor, float metallic, float roughness, float least,
                              float nv) {
  float share = dielectricShare(roughness) * (1.0f - metallic);
  float alpha = max(roughness, least) * max(roughness, least);
  Lobe lobe;
  lobe.straight = vec4(metallic * baseColor + vec3(kDielectric * share), metallic + share);
  lobe.shape = vec4(alpha * alpha, max(nv, kLeastCosine), 0.0f, 0.0f);
  return lobe;
}

// What a dielectric's lobe reflects of light from one direction, over all directions: a fit to the
// integral, at most 0.03 off, for roughness from 0.1.
SHARED_FUNCTION float dielectricAlbedo(float roughness, float least, float nv) {
  float r = max(roughness, least), r2 = r * r;
  float away = 1.0f - max(nv, kLeastCosine);
  return kDielectric * (1.0f - r2 * r) +
         0.96f / (1.0f + 14.9f * r2 + 1.2f * r2 * r2) * pow(away, 5.0f - 9.42f * r + 7.85f * r2);
}

// By which the albedo is multiplied for what is diffuse.
SHARED_FUNCTION float diffuseShare(float metallic, float roughness, float least, float nv) {
  if (!isGlossy(metallic, roughness)) return 1.0f;
  return (1.0f - metallic) *
         (1.0f - dielectricShare(roughness) * dielectricAlbedo(roughness, least, nv));
}

// How much wider a lobe is taken for a light sample that stands for a solid angle Ω of light, so
// that it does not show as a spot. Seen in the lobe, half vectors within Ω / (4 v·h) reflect it
// (Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, equation 14).
// The lobe, which is about the area π α² of half vectors, grows by kSpread times that:
//   α'² = α² + kSpread · Ω / (4π v·h)
// as Karis ("Real Shading in Unreal Engine 4", 2013) widens it by the angle of an area light, and
// in place of gathering over a sphere around the sample (Hašan et al., "Virtual Spherical Lights
// for Many-Light Rendering of Glossy Scenes", 2009). D is at most 1/(π α'²), so that where the half
// vector is about the normal one sample's highlight is at most 1/kSpread of F times the light it
// stands for, which is a mirror's picture of it: several make up what is seen. With kSpread 1 they
// stand out of their sum, in the test by 60%. Highlights are softer by what the samples span, and
// darker where that is much: at roughness 0.25 by 1% of 0.03 sr, 4% of 0.08 sr, 17% of 0.3 sr. Both
// go to nothing as samples become many.
SHARED_CONST float kSpread = 4.0f;
SHARED_FUNCTION float widened(float alpha2, float solidAngle, float vh) {
  return min(alpha2 + kSpread * 0.0795774715f * solidAngle / vh, 1.0f);
}

// D·V·F at the normal n for light from l, seen from v (all unit); solidAngle: what the light stands
// for [sr], 0 for a point. Not multiplied by n·l. 0 where n·l ≤ 0.
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
