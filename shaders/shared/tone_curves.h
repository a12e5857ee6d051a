// Tone mapping: scene-referred radiance to display colours.
#ifndef LAMPLIGHTER_SHARED_TONE_CURVES_H
#define LAMPLIGHTER_SHARED_TONE_CURVES_H
#include "interop.h"

SHARED_BEGIN

// ToneMapper
SHARED_CONST int kToneLinear = 0, kToneReinhard = 1, kToneFilmic = 2, kToneHable = 3, kToneAgx = 4;

// Exposed radiance above which everything is white.
SHARED_CONST float kMostExposed = 1e4f;

// Reinhard et al., "Photographic Tone Reproduction for Digital Images" (2002), eq. 4, applied to
// luminance.
SHARED_FUNCTION vec3 reinhardCurve(vec3 x) {
  const float white = 4.0f;
  float l = dot(x, vec3(0.2126f, 0.7152f, 0.0722f));
  return x * ((1.0f + l / (white * white)) / (1.0f + l));
}

// K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016), a fit of the Academy's curve.
SHARED_FUNCTION vec3 filmicCurve(vec3 x) {
  return x * (2.51f * x + 0.03f) / (x * (2.43f * x + 0.59f) + 0.14f);
}

// J. Hable, "Uncharted 2: HDR Lighting" (GDC 2010): his curve with the constants of the talk.
SHARED_FUNCTION vec3 hableUnscaled(vec3 v) {
  const float a = 0.15f, b = 0.50f, c = 0.10f, d = 0.20f, e = 0.02f, f = 0.30f;
  return (v * (a * v + c * b) + d * e) / (v * (a * v + b) + d * f) - e / f;
}
SHARED_FUNCTION vec3 hableCurve(vec3 x) {
  const float exposure = 2.0f, white = 11.2f;
  return hableUnscaled(exposure * x) / hableUnscaled(vec3(white));
}

// T. Sobotka's AgX (2022): transforms to less saturated primaries, applies a sigmoid to the
// logarithm, and transforms back. The sigmoid is the polynomial fit of B. Wrensch, "Minimal AgX
// Implementation" (2023). The result is display-referred, encoded with a power of 2.2.
SHARED_FUNCTION vec3 agxCurve(vec3 x) {
  const mat3 inset = mat3(0.842479062f, 0.0423282423f, 0.0423756549f, 0.0784336f, 0.878468636f,
                          0.0784336f, 0.0792237451f, 0.0791661275f, 0.879142974f);
  const mat3 outset = mat3(1.19687901f, -0.0528968518f, -0.0529716355f, -0.0980208811f, 1.15190313f,
                           -0.0980434501f, -0.0990297441f, -0.0989611768f, 1.15107367f);
  const float lowest = -12.47393f, highest = 4.026069f;  // [EV]
  vec3 stops = log2(max(inset * x, vec3(1e-10f)));
  vec3 t = clamp((stops - lowest) / (highest - lowest), 0.0f, 1.0f);
  vec3 t2 = t * t, t4 = t2 * t2;
  vec3 curve = 15.5f * t4 * t2 - 40.14f * t4 * t + 31.96f * t4 - 6.868f * t2 * t + 0.4298f * t2 +
               0.1191f * t - 0.00232f;
  return outset * curve;
}

// sRGB encoding of a linear value (IEC 61966-2-1); values ≥ 1 give 1.
SHARED_FUNCTION float encodeSrgb(float v) {
  if (v >= 1.0f) return 1.0f;  // the formula would be one bit below 1
  return v <= 0.0031308f ? 12.92f * v : 1.055f * pow(v, 1.0f / 2.4f) - 0.055f;
}

// scale: 2^exposure. Infinite radiance becomes white; NaN becomes black, so that it is noticed in a
// lit picture.
SHARED_FUNCTION vec3 toneMap(vec3 radiance, float scale, int mapper) {
  vec3 x = radiance * scale;
  vec3 bounded = mix(clamp(x, 0.0f, kMostExposed), vec3(0.0f), isnan(x));
  vec3 curve = bounded;
  if (mapper == kToneReinhard) curve = reinhardCurve(bounded);
  if (mapper == kToneFilmic) curve = filmicCurve(bounded);
  if (mapper == kToneHable) curve = hableCurve(bounded);
  if (mapper == kToneAgx) curve = agxCurve(bounded);
  vec3 shown = clamp(curve, 0.0f, 1.0f);
  if (mapper != kToneAgx)
    shown = vec3(encodeSrgb(shown.x), encodeSrgb(shown.y), encodeSrgb(shown.z));
  shown = mix(shown, vec3(1.0f), greaterThan(x, vec3(kMostExposed)));
  return mix(shown, vec3(0.0f), isnan(x));
}

SHARED_END
#endif
