// Unit vectors in two floats: the octahedron |x| + |y| + |z| = 1 unfolded onto a square (Meyer et
// al., "On Floating-Point Normal Vectors", 2010).
#ifndef LAMPLIGHTER_NORMAL_PACKING_GLSL
#define LAMPLIGHTER_NORMAL_PACKING_GLSL

vec2 signNotZero(vec2 v) {
  return vec2(v.x >= 0.0 ? 1.0 : -1.0, v.y >= 0.0 ? 1.0 : -1.0);
}

vec2 packNormal(vec3 n) {
  vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
  return n.z >= 0.0 ? p : (1.0 - abs(p.yx)) * signNotZero(p);
}

vec3 unpackNormal(vec2 p) {
  vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * signNotZero(n.xy);
  return normalize(n);
}

#endif
