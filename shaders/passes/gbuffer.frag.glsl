// The surface at a point of a triangle: renderer/scene/surface.cpp on the GPU. It fetches the
// corners of the triangle, so that the geometric normal and the plane are exact and not computed
// from pixel differences; the shadow test compares in that plane.
#include "common/material.glsl"
#include "common/normal_packing.glsl"

layout(std430, binding = kPositionBuffer) readonly buffer Positions { float positions[]; };
layout(std430, binding = kIndexBuffer) readonly buffer Indices { uint indices[]; };
layout(std430, binding = kUv0Buffer) readonly buffer Uv0s { vec2 uv0s[]; };
layout(std430, binding = kUv1Buffer) readonly buffer Uv1s { vec2 uv1s[]; };

layout(location = 1) uniform vec3 uEye;

layout(location = 0) in vec3 vPosition;
layout(location = 1) in vec3 vNormal;
layout(location = 2) in vec4 vColor;
layout(location = 3) flat in uint vFirstIndex;
#ifdef TEXTURED
layout(location = 4) in vec2 vUv0;
layout(location = 5) in vec2 vUv1;
layout(location = 6) in vec4 vTangent;
#endif

layout(location = kGPosition) out vec4 outPosition;
layout(location = kGNormals) out vec4 outNormals;
layout(location = kGAlbedo) out vec4 outAlbedo;
layout(location = kGEmission) out vec4 outEmission;
layout(location = kGlossTarget) out vec2 outGloss;

vec3 positionOf(uint i) {
  return vec3(positions[3u * i], positions[3u * i + 1u], positions[3u * i + 2u]);
}

#ifdef TEXTURED
// The tangent if the file has none: the direction of growing u in the plane of the triangle,
// orthogonal to n. w: handedness; 0 if there is no such direction.
vec4 tangentOf(uvec3 corner, vec3 e1, vec3 e2, vec3 n) {
  float given = length(vTangent.xyz);
  if (given > 1e-6) return vec4(vTangent.xyz / given, vTangent.w < 0.0 ? -1.0 : 1.0);
  bool second = uMaterial.normalLookup.u.w > 0.5;
  vec2 a = second ? uv1s[corner.x] : uv0s[corner.x];
  vec2 d1 = (second ? uv1s[corner.y] : uv0s[corner.y]) - a;
  vec2 d2 = (second ? uv1s[corner.z] : uv0s[corner.z]) - a;
  float det = d1.x * d2.y - d1.y * d2.x;
  if (det == 0.0) return vec4(0.0);
  vec3 t = (e1 * d2.y - e2 * d1.y) * (det < 0.0 ? -1.0 : 1.0);
  t -= n * dot(n, t);
  float l = length(t);
  return l > 0.0 ? vec4(t / l, det < 0.0 ? 1.0 : -1.0) : vec4(0.0);  // v points down in glTF
}

vec3 mappedNormal(uvec3 corner, vec3 e1, vec3 e2, vec3 n) {
  if (uMaterial.normalLookup.v.w < 0.5) return n;
  vec4 tangent = tangentOf(corner, e1, e2, n);
  vec3 t = tangent.xyz - n * dot(n, tangent.xyz);
  float l = length(t);
  if (tangent.w == 0.0 || l <= 0.0) return n;
  t /= l;
  vec3 b = cross(n, t) * tangent.w;
  vec3 q = lookUp(uNormal, uMaterial.normalLookup, vUv0, vUv1).xyz * 2.0 - 1.0;
  q.xy *= uMaterial.options.y;
  vec3 mapped = q.x * t + q.y * b + q.z * n;
  float length2 = dot(mapped, mapped);
  return length2 > 0.0 ? mapped * inversesqrt(length2) : n;
}
#endif

void main() {
  vec4 color = uMaterial.baseColor * vColor;
#ifdef TEXTURED
  if (uMaterial.baseColorLookup.v.w > 0.5) {
    color *= lookUp(uBaseColor, uMaterial.baseColorLookup, vUv0, vUv1);
  }
#endif
#ifdef ALPHA_MASK
  if (color.a < uMaterial.options.x) discard;
#endif

  uint first = vFirstIndex + 3u * uint(gl_PrimitiveID);
  uvec3 corner = uvec3(indices[first], indices[first + 1u], indices[first + 2u]);
  vec3 p0 = positionOf(corner.x);
  vec3 e1 = positionOf(corner.y) - p0;
  vec3 e2 = positionOf(corner.z) - p0;
  vec3 area = cross(e1, e2);
  float doubleArea = length(area);
  vec3 geometric = doubleArea > 0.0 ? area / doubleArea : vec3(0.0, 0.0, 1.0);
  float normalLength = length(vNormal);
  vec3 n = normalLength > 0.0 ? vNormal / normalLength : geometric;
  if (dot(n, geometric) < 0.0) n = -n;  // the winding decides which side is the front
#ifdef TEXTURED
  n = mappedNormal(corner, e1, e2, n);
#endif

  vec3 position = vPosition - geometric * dot(geometric, vPosition - p0);
  bool front = dot(position - uEye, geometric) < 0.0;
  float side = front ? 1.0 : -1.0;
  vec3 emission = front || uMaterial.emissive.w > 0.5 ? uMaterial.emissive.rgb : vec3(0.0);
#ifdef TEXTURED
  if (uMaterial.emissiveLookup.v.w > 0.5) {
    emission *= lookUp(uEmissive, uMaterial.emissiveLookup, vUv0, vUv1).rgb;
  }
#endif
  uint triangle = vFirstIndex / 3u + uint(gl_PrimitiveID);
  outPosition = vec4(position, uintBitsToFloat(uint(kTriangleBits) + triangle));
  outNormals = vec4(packNormal(side * n), packNormal(side * geometric));
  outAlbedo = vec4(clamp(color.rgb, 0.0, 1.0), 1.0);
  outEmission = vec4(emission, 1.0);
  vec2 gloss = uMaterial.options.zw;
#ifdef TEXTURED
  if (uMaterial.glossLookup.v.w > 0.5) {
    gloss *= lookUp(uGloss, uMaterial.glossLookup, vUv0, vUv1).bg;
  }
#endif
  outGloss = gloss;
}
