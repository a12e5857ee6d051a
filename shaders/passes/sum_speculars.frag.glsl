// Sums the specular light of glossy pixels from some VPLs of one kind whose maps lie in one array.
// Draws are blended additively.
#include "common/gloss.glsl"
#include "common/shadow_look_up.glsl"
#include "common/vpls.glsl"
#include "shared/vpl_speculars.h"
#ifdef LINKS
#include "common/left_out.glsl"
#endif

layout(location = 2) uniform int uFirst;  // index into uVpls
layout(location = 3) uniform int uEnd;
layout(location = 4) uniform vec4 uClampAndBias;  // ShadingParams

layout(location = 0) out vec4 outRadiance;

void main() {
  GlossyPoint p = glossyPoint(ivec2(gl_FragCoord.xy));
  Lobe lobe = makeLobe(p.albedo, p.metallic, p.roughness, uLeastRoughness, dot(p.shading, p.toEye));
  vec3 sum = vec3(0.0);
#ifdef LINKS
  uint leftOutBy = leftOutAt(texelFetch(uPosition, ivec2(gl_FragCoord.xy), 0).w);
#endif
  for (int i = uFirst; i < uEnd; ++i) {
    Vpl vpl = uVpls[i];
    // a compile-time constant, so that the compiler removes the other kinds
    vpl.position.w = VPL_KIND;
    float g = vplGeometry(vpl, p.position, p.shading, p.geometric, uClampAndBias.x);
    if (g <= 0.0) continue;
#ifdef LINKS
    if (isLeftOut(leftOutBy, vpl.footprint.y)) continue;
#endif
    if (vpl.slot >= 0 && occluded(vpl, p.position, p.geometric, uClampAndBias)) continue;
    sum += vpl.intensity.rgb *
           vplSpecular(vpl, lobe, p.position, p.shading, p.toEye, g, uClampAndBias.x);
  }
  outRadiance = vec4(sum, 0.0);
}
