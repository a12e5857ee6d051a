// A material in the layout of the gl backend's shaders.
#ifndef LAMPLIGHTER_SHARED_MATERIAL_H
#define LAMPLIGHTER_SHARED_MATERIAL_H
#include "interop.h"

SHARED_BEGIN

// Texture coordinates: u = dot(u.xyz, (uv, 1)), v = dot(v.xyz, (uv, 1)) (KHR_texture_transform).
struct TextureLookup {
  vec4 u;  // w: 1 for the second set of texture coordinates
  vec4 v;  // w: 1 if there is a texture
};

struct SurfaceMaterial {
  vec4 baseColor;  // linear
  vec4 emissive;   // rgb [W/(m² sr)]; w: 1 if both sides emit
  vec4 options;    // x: alpha cutoff, y: normal scale, z: metallic, w: roughness
  TextureLookup baseColorLookup;
  TextureLookup normalLookup;
  TextureLookup emissiveLookup;
  TextureLookup glossLookup;  // G: roughness, B: metallic
};

SHARED_END
#endif
