// The place of each pixel (shared/patches.h), and what its light map says: ObjectPatches::leafAt()
// and LightMaps::irradiance() on the GPU. At all pixels, or at one of each block.
#include "common/cells.glsl"
#include "common/normal_packing.glsl"
#include "shared/bindings.h"
#include "shared/patches.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;
layout(location = 0) uniform int uBlock;  // pixels a side, 1: all of them

layout(std430, binding = kRootBuffer) readonly buffer Roots { uint roots[]; };
layout(std430, binding = kPatchBuffer) readonly buffer Nodes { PatchNode nodes[]; };
layout(std430, binding = kChartBuffer) readonly buffer Charts { PatchChart charts[]; };
layout(std430, binding = kTileBuffer) readonly buffer Tiles { PatchTile tiles[]; };
layout(std430, binding = kTexelBuffer) readonly buffer Texels { vec4 texels[]; };

layout(location = 0) out vec4 outIrradiance;
layout(location = 1) out uint outPlace;

vec3 irradianceAt(PatchTile tile, vec2 p) {
  vec2 last = vec2(tile.texels.yz) - 1.0;
  vec2 at = clamp((p - tile.frame.xy) * tile.frame.zw, vec2(0.0), last);
  vec2 low = min(floor(at), last - 1.0);
  vec2 w = at - low;
  uint columns = tile.texels.y;
  uint first = tile.texels.x + uint(low.y) * columns + uint(low.x);
  vec3 top = mix(texels[first].rgb, texels[first + 1u].rgb, w.x);
  vec3 bottom = mix(texels[first + columns].rgb, texels[first + columns + 1u].rgb, w.x);
  return mix(top, bottom, w.y);
}

void main() {
  ivec2 last = textureSize(uPosition, 0) - 1;
  ivec2 pixel = pixelOfSample(ivec2(gl_FragCoord.xy), uBlock, last);
  vec4 position = texelFetch(uPosition, pixel, 0);
  outIrradiance = vec4(0.0);
  outPlace = 0u;
  if (position.w == 0.0) return;
  uint leaf = roots[floatBitsToUint(position.w) - uint(kTriangleBits)];
  uvec4 node = nodes[leaf].branch;
  bool mapped = false;
  if (node.y != 0u) {
    PatchChart chart = charts[node.y - 1u];
    vec3 v = position.xyz - chart.origin.xyz;
    vec2 p = vec2(dot(v, chart.tangent.xyz), dot(v, chart.bitangent.xyz));
    while (node.x != 0u) {
      leaf = node.x + ((node.z == 0u ? p.x : p.y) < uintBitsToFloat(node.w) ? 0u : 1u);
      node = nodes[leaf].branch;
    }
    vec3 front = cross(chart.tangent.xyz, chart.bitangent.xyz);
    vec3 geometric = unpackNormal(texelFetch(uNormals, pixel, 0).zw);
    mapped = node.z != 0u && dot(geometric, front) > 0.0;
    if (mapped) outIrradiance.rgb = irradianceAt(tiles[node.z - 1u], p);
  }
  outPlace = 1u + 2u * leaf + (mapped ? 1u : 0u);
}
