// Finds the place of each pixel (shared/patches.h) and reads its light map, or the light by
// radiance transfer at the corners of the triangle: ObjectPatches::leafAt(),
// LightMaps::irradiance() and PrtLights::irradiance() on the GPU.
#include "common/normal_packing.glsl"
#include "shared/bindings.h"
#include "shared/patches.h"

layout(binding = kGPosition) uniform sampler2D uPosition;
layout(binding = kGNormals) uniform sampler2D uNormals;

layout(std430, binding = kRootBuffer) readonly buffer Roots { uint roots[]; };
layout(std430, binding = kPatchBuffer) readonly buffer Nodes { PatchNode nodes[]; };
layout(std430, binding = kChartBuffer) readonly buffer Charts { PatchChart charts[]; };
layout(std430, binding = kTileBuffer) readonly buffer Tiles { PatchTile tiles[]; };
layout(std430, binding = kTexelBuffer) readonly buffer Texels { vec4 texels[]; };

layout(std430, binding = kCornerBuffer) readonly buffer Corners { uint corners[]; };
layout(std430, binding = kPlaceBuffer) readonly buffer Places { float places[]; };
layout(std430, binding = kVertexLightBuffer) readonly buffer VertexLight { float light[]; };

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

vec3 placeOf(uint vertex) {
  return vec3(places[3u * vertex], places[3u * vertex + 1u], places[3u * vertex + 2u]);
}

vec3 lightAt(uint vertex) {
  return vec3(light[3u * vertex], light[3u * vertex + 1u], light[3u * vertex + 2u]);
}

// Adds the light by radiance transfer at a point of a triangle, if the normal is on its front.
// first: offset to add to vertex indices.
bool addTransfer(uint triangle, uint first, vec3 position, vec3 normal, inout vec3 sum) {
  uvec3 corner =
      uvec3(corners[3u * triangle], corners[3u * triangle + 1u], corners[3u * triangle + 2u]);
  vec3 a = placeOf(corner.x);
  vec3 u = placeOf(corner.y) - a, v = placeOf(corner.z) - a, p = position - a;
  if (dot(normal, cross(u, v)) <= 0.0) return false;
  // Weights of the second and third corner by least squares.
  float uu = dot(u, u), uv = dot(u, v), vv = dot(v, v);
  float pu = dot(p, u), pv = dot(p, v), area2 = uu * vv - uv * uv;
  float second = 0.0, third = 0.0;
  if (area2 > 0.0) {
    second = clamp((vv * pu - uv * pv) / area2, 0.0, 1.0);
    third = clamp((uu * pv - uv * pu) / area2, 0.0, 1.0 - second);
  }
  corner += first;
  sum += (1.0 - second - third) * lightAt(corner.x) + second * lightAt(corner.y) +
         third * lightAt(corner.z);
  return true;
}

void main() {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec4 position = texelFetch(uPosition, pixel, 0);
  outIrradiance = vec4(0.0);
  outPlace = 0u;
  if (position.w == 0.0) return;
  uint triangle = floatBitsToUint(position.w) - uint(kTriangleBits);
  uint leaf = roots[triangle];
  uvec4 node = nodes[leaf].branch;
  vec3 geometric = unpackNormal(texelFetch(uNormals, pixel, 0).zw);
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
    mapped = node.z != 0u && dot(geometric, front) > 0.0;
    if (mapped) outIrradiance.rgb = irradianceAt(tiles[node.z - 1u], p);
  } else if (node.z != 0u) {
    mapped = addTransfer(triangle, node.w, position.xyz, geometric, outIrradiance.rgb);
  }
  outPlace = 1u + 2u * leaf + (mapped ? 1u : 0u);
}
