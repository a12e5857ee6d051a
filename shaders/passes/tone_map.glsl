// From scene-referred radiance to a picture on a display: what renderer/image/tone_map.cpp does, so
// that the window and a written PNG look the same.
#ifndef LAMPLIGHTER_TONE_MAP_GLSL
#define LAMPLIGHTER_TONE_MAP_GLSL

// The filmic curve of K. Narkowicz, "ACES Filmic Tone Mapping Curve" (2016).
vec3 filmic(vec3 x) {
  return clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
}

vec3 encodeSrgb(vec3 v) {
  return mix(1.055 * pow(v, vec3(1.0 / 2.4)) - 0.055, 12.92 * v, lessThanEqual(v, vec3(0.0031308)));
}

// scale: 2^exposure. Infinite radiance is white; what is no number is black, so that it stands out
// in a lit picture.
vec3 toneMap(vec3 radiance, float scale) {
  vec3 x = radiance * scale;
  vec3 curve = encodeSrgb(filmic(clamp(x, 0.0, 1e4)));
  vec3 shown = mix(curve, vec3(1.0), greaterThan(x, vec3(1e4)));
  return mix(shown, vec3(0.0), isnan(x));
}

#endif
