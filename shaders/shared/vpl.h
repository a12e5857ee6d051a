// A virtual point light as the backends take it.
#ifndef LAMPLIGHTER_SHARED_VPL_H
#define LAMPLIGHTER_SHARED_VPL_H
#include "interop.h"

SHARED_BEGIN

// Kinds, in Vpl.position.w.
SHARED_CONST float kVplCosine = 0.0f;       // oriented: I·cos θ (area lights, bounces)
SHARED_CONST float kVplUniform = 1.0f;      // I over the hemisphere, × the spot's cone (punctual)
SHARED_CONST float kVplDirectional = 2.0f;  // parallel light from +normal (sun, one sky direction)

// All in world space. The shadow map's frame is (tangent, cross(normal, tangent), normal).
struct Vpl {
  vec4 position;   // xyz: place [m] (directional: middle of its square); w: kind
  vec4 normal;     // xyz: unit axis of the hemisphere lit (directional: towards the light);
                   // w: spot: angular scale; directional: R [m], all of the scene is within R of
                   // the plane through its position
  vec4 tangent;    // xyz: unit; w: spot: angular offset (no spot: scale 0, offset 1);
                   // directional: S [m], it lights (and its map covers) only what is within ±S
                   // along tangent and bitangent, so that a sun can be several squares
  vec4 intensity;  // rgb: on-axis intensity [W/sr], directional: irradiance [W/m²];
                   // w: slot of its shadow map, < 0: casts no shadow
  // x: what it stands for, for speculars: cosine: area of surface [m²], directional: solid angle
  // [sr]; 0: nothing but its point or direction. No map or irradiance depends on it.
  // y: its light's link, whose objects it does not light (renderer/scene/light_linking.h), 0: it
  // lights all. zw: 0.
  vec4 footprint SHARED_ZERO;
};

// How shading bounds and biases; the same on both backends.
struct ShadingParams {
  // x: least distance d0 [m], 1/d² is clamped to 1/d0²; y: shadow bias as a share of the distance;
  // z: for shaders: resolution of the maps that they look up [texels a side]; w: VPLs that one draw
  // of the gl backend adds to a pixel at most
  vec4 clampAndBias;
  // x: pixels a side of the blocks of the low-resolution pass (low_resolution.h), 1: none; y: 1: of
  // its samples, too, some are interpolated; zw: 0
  vec4 block;
  // x: 1: what is seen has speculars (vpl_speculars.h), 0: all is Lambert's; y: least roughness;
  // zw: 0
  vec4 speculars SHARED_ZERO;
};

SHARED_END
#endif
