// Outgoing radiance: Le + ρ/π · E, and the sky where nothing was hit.
#include "shared/bindings.h"

layout(binding = kGAlbedo) uniform sampler2D uAlbedo;
layout(binding = kGEmission) uniform sampler2D uEmission;
layout(binding = kIrradiance) uniform sampler2D uIrradiance;
layout(location = 0) uniform vec3 uSky;
layout(location = 1) uniform int uWhite;  // 1: as if every surface were white

layout(location = 0) out vec4 outRadiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  const float kInversePi = 0.318309886;
  vec4 surface = texelFetch(uAlbedo, pixel, 0);
  vec3 albedo = uWhite != 0 ? vec3(1.0) : surface.rgb;
  // Light maps are interpolated and the shadows taken away from them are not: no light may be left
  // less than none.
  vec3 irradiance = texelFetch(uIrradiance, pixel, 0).rgb;
  irradiance = mix(irradiance, vec3(0.0), lessThan(irradiance, vec3(0.0)));
  vec3 radiance = texelFetch(uEmission, pixel, 0).rgb + albedo * kInversePi * irradiance;
  outRadiance = vec4(surface.a != 0.0 ? radiance : uSky, 1.0);
}
