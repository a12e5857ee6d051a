// A material as the gl backend's shaders take it.
#ifndef LAMPLIGHTER_SHARED_MATERIAL_H
#define LAMPLIGHTER_SHARED_MATERIAL_H
#include "interop.h"

SHARED_BEGIN

// Where to look in a texture: u = dot(u.xyz, (uv, 1)), v likewise (KHR_texture_transform).
struct TextureLookup {
  vec4 u;  // w: 1 for the second set of texture coordinates
  vec4 v;  // w: 1 when there is a texture
};

struct SurfaceMaterial {
  vec4 baseColor;  // linear
  vec4 emissive;   // rgb [W/(m² sr)]; w: 1 when it leaves both sides
  vec4 options;    // x: alpha cutoff, y: normal scale, z: metallic, w: roughness
  TextureLookup baseColorLookup;
  TextureLookup normalLookup;
  TextureLookup emissiveLookup;
  TextureLookup glossLookup;  // G: roughness, B: metallic
};

SHARED_END
#endif
