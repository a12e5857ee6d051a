// Converts a Lambertian picture, Le + ρ/π · E, to one with speculars: adds the light of the lobes
// and subtracts what the diffuse part loses.
#include "common/gloss.glsl"

layout(binding = kIrradiance) uniform sampler2D uIrradiance;
layout(binding = kSpeculars) uniform sampler2D uSpeculars;

layout(location = 0) out vec4 outRadiance;

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  GlossyPoint p = glossyPoint(pixel);
  const float kInversePi = 0.318309886;
  vec3 irradiance = texelFetch(uIrradiance, pixel, 0).rgb;
  irradiance = mix(irradiance, vec3(0.0), lessThan(irradiance, vec3(0.0)));  // as compose.frag.glsl
  float lost =
      1.0 - diffuseShare(p.metallic, p.roughness, uLeastRoughness, dot(p.shading, p.toEye));
  outRadiance = vec4(
      texelFetch(uSpeculars, pixel, 0).rgb - lost * kInversePi * p.albedo * irradiance, 0.0);
}
