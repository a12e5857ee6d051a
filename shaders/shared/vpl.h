// A virtual point light in the layout of the backends.
#ifndef LAMPLIGHTER_SHARED_VPL_H
#define LAMPLIGHTER_SHARED_VPL_H
#include "interop.h"

SHARED_BEGIN

// Kinds, in Vpl.position.w.
SHARED_CONST float kVplCosine = 0.0f;   // oriented, I·cos θ (area lights, bounces)
SHARED_CONST float kVplUniform = 1.0f;  // I over the hemisphere, × the spot's cone (punctual)
// directional light from +normal (sun, one sky direction)
SHARED_CONST float kVplDirectional = 2.0f;

// All in world space. The shadow map's frame is (tangent, cross(normal, tangent), normal).
struct Vpl {
  vec4 position;  // xyz: position [m] (directional: middle of its square); w: kind
  // xyz: unit axis of the lit hemisphere (directional: towards the light); w: spot: angular scale;
  // directional: R [m], the whole scene is within R of the plane through its position
  vec4 normal;
  // xyz: unit vector; w: spot: angular offset (no spot: scale 0, offset 1); directional: S [m], it
  // lights (and its map covers) only points within ±S along tangent and bitangent, so that a sun
  // can consist of several squares
  vec4 tangent;
  vec3 intensity;  // rgb: on-axis intensity [W/sr], directional: irradiance [W/m²]
  // of its shadow map; < 0: casts no shadow. In shaders: the layer of its map.
  int slot;
  // x: the extent that it represents, for speculars. Cosine: area of surface [m²]; directional:
  // solid angle [sr]; 0: only its point or direction. Maps and irradiance do not depend on it.
  // y: the link of its light, whose objects it does not light (renderer/scene/light_linking.h); 0:
  // it lights all. zw: 0.
  vec4 footprint SHARED_ZERO;
};

SHARED_CONST float kLightPixelsUnit = 65536.0f;

// Clamp and bias of shading; the same on both backends.
struct ShadingParams {
  // x: smallest distance d0 [m], 1/d² is clamped to 1/d0²; y: shadow bias as a share of the
  // distance; z: for shaders: resolution of the maps that they read [texels per side]; w: largest
  // number of VPLs per draw of the gl backend
  vec4 clampAndBias;
  // x: pixels per side of the blocks of the low-resolution pass (low_resolution.h), 1: off; y: 1:
  // some of its samples are also interpolated; z: limit of lights × pixels at edges, in units of
  // kLightPixelsUnit, above which pixels take the light of samples until later calls (cpu backend);
  // 0: none; w: 1: speculars are summed at the samples of the low-resolution pass and interpolated
  // (cpu backend)
  vec4 block;
  // x: 1: visible surfaces have speculars (vpl_speculars.h), 0: all is Lambertian; y: smallest
  // roughness; zw: 0
  vec4 speculars SHARED_ZERO;
};

SHARED_END
#endif
