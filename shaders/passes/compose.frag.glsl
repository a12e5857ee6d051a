// Outgoing radiance: Le + ρ/π · E, and the sky where nothing was hit.
// SKY_KIND is a compile-time constant because llvmpipe executes all branches.
#include "shared/bindings.h"
#include "shared/sky.h"

layout(binding = kGAlbedo) uniform sampler2D uAlbedo;
layout(binding = kGEmission) uniform sampler2D uEmitted;
layout(binding = kIrradiance) uniform sampler2D uIrradiance;
layout(binding = kSkyPicture) uniform sampler2D uSkyPicture;
layout(location = 0) uniform vec3 uSky;   // constant, or the gradient's horizon
layout(location = 1) uniform int uWhite;  // 1: all surfaces white
layout(location = 2) uniform vec3 uZenith;
layout(location = 3) uniform vec3 uGround;
layout(location = 4) uniform int uEmission;  // 0: only the light that surfaces reflect
layout(location = 5) uniform vec2 uSkyPictureUse;  // rotation [rad], scale
// The view ray of the picture's top left corner (not normalised), and its change per pixel.
layout(location = 6) uniform vec3 uCorner;
layout(location = 7) uniform vec3 uRight;
layout(location = 8) uniform vec3 uDown;
layout(location = 9) uniform vec2 uJitter;  // from the middle of a pixel

layout(location = 0) out vec4 outRadiance;

// Sky::radianceFrom(): interpolated in full precision; a sampler interpolates with only 8 bits.
vec3 skyPicture(vec3 towards) {
  ivec2 size = textureSize(uSkyPicture, 0);
  vec2 at = skyCoordinates(towards, uSkyPictureUse.x) * vec2(size) - 0.5;
  vec2 base = floor(at), t = at - base;
  ivec2 low = ivec2(base), high = low + 1;
  low = ivec2((low.x + size.x) % size.x, max(low.y, 0));
  high = ivec2(high.x % size.x, min(high.y, size.y - 1));
  vec3 top = mix(texelFetch(uSkyPicture, low, 0).rgb,
                 texelFetch(uSkyPicture, ivec2(high.x, low.y), 0).rgb, t.x);
  vec3 bottom = mix(texelFetch(uSkyPicture, ivec2(low.x, high.y), 0).rgb,
                    texelFetch(uSkyPicture, high, 0).rgb, t.x);
  return uSkyPictureUse.y * mix(top, bottom, t.y);
}

vec3 skySeen(vec2 pixel) {
  if (SKY_KIND == kSkyConstant) return uSky;
  vec2 at = pixel + 0.5 + uJitter;
  vec3 towards = normalize(uCorner + at.x * uRight + at.y * uDown);
  if (SKY_KIND == kSkyGradient) return skyGradient(uZenith, uSky, uGround, towards.y);
  return skyPicture(towards);
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 surface = texelFetch(uAlbedo, pixel, 0);
  if (surface.a == 0.0) {
    outRadiance = vec4(uEmission != 0 ? skySeen(vec2(pixel)) : vec3(0.0), 1.0);
    return;
  }
  const float kInversePi = 0.318309886;
  vec3 albedo = uWhite != 0 ? vec3(1.0) : surface.rgb;
  // Clamped at 0: light maps are interpolated, but the shadows subtracted from them are not.
  vec3 irradiance = texelFetch(uIrradiance, pixel, 0).rgb;
  irradiance = mix(irradiance, vec3(0.0), lessThan(irradiance, vec3(0.0)));
  vec3 radiance = albedo * kInversePi * irradiance;
  if (uEmission != 0) radiance += texelFetch(uEmitted, pixel, 0).rgb;
  outRadiance = vec4(radiance, 1.0);
}
