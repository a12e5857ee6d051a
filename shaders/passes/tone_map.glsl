// Converts scene-referred radiance to display colours, like renderer/image/tone_map.cpp, so that
// the window and a written PNG look equal. That file cites the sources of the curves.
#ifndef LAMPLIGHTER_TONE_MAP_GLSL
#define LAMPLIGHTER_TONE_MAP_GLSL

// ToneMapper
const int kLinear = 0, kReinhard = 1, kFilmic = 2, kHable = 3, kAgx = 4;

vec3 filmic(vec3 x) {
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 reinhard(vec3 x) {
  const float kWhite = 4.0;
  float l = dot(x, vec3(0.2126, 0.7152, 0.0722));
  return x * ((1.0 + l / (kWhite * kWhite)) / (1.0 + l));
}

vec3 hableCurve(vec3 v) {
  const float a = 0.15, b = 0.50, c = 0.10, d = 0.20, e = 0.02, f = 0.30;
  return (v * (a * v + c * b) + d * e) / (v * (a * v + b) + d * f) - e / f;
}

vec3 agx(vec3 x) {
  const mat3 inset =
      mat3(0.842479062, 0.0423282423, 0.0423756549, 0.0784336, 0.878468636, 0.0784336, 0.0792237451,
           0.0791661275, 0.879142974);
  const mat3 outset =
      mat3(1.19687901, -0.0528968518, -0.0529716355, -0.0980208811, 1.15190313, -0.0980434501,
           -0.0990297441, -0.0989611768, 1.15107367);
  const float kLowest = -12.47393, kHighest = 4.026069;
  vec3 stops = log2(max(inset * x, vec3(1e-10)));
  vec3 t = clamp((stops - kLowest) / (kHighest - kLowest), 0.0, 1.0);
  vec3 t2 = t * t, t4 = t2 * t2;
  vec3 curve = 15.5 * t4 * t2 - 40.14 * t4 * t + 31.96 * t4 - 6.868 * t2 * t + 0.4298 * t2 +
               0.1191 * t - 0.00232;
  return outset * curve;
}

vec3 encodeSrgb(vec3 v) {
  return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}

// scale: 2^exposure. Infinite radiance becomes white; NaN becomes black, so that it is visible in a
// lit picture.
vec3 toneMap(vec3 radiance, float scale, int mapper) {
  vec3 x = radiance * scale;
  vec3 bounded = mix(clamp(x, 0.0, 1e4), vec3(0.0), isnan(x));
  vec3 curve = bounded;
  if (mapper == kReinhard) curve = reinhard(bounded);
  if (mapper == kFilmic) curve = filmic(bounded);
  if (mapper == kHable) curve = hableCurve(2.0 * bounded) / hableCurve(vec3(11.2));
  if (mapper == kAgx) curve = agx(bounded);
  curve = clamp(curve, 0.0, 1.0);
  vec3 encoded = mapper == kAgx ? curve : encodeSrgb(curve);
  vec3 shown = mix(encoded, vec3(1.0), greaterThan(x, vec3(1e4)));
  return mix(shown, vec3(0.0), isnan(x));
}

#endif
