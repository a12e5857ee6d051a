// Patches and their light maps (renderer/patches, renderer/light_maps) in the layout of the gl
// backend's shaders.
#ifndef LAMPLIGHTER_SHARED_PATCHES_H
#define LAMPLIGHTER_SHARED_PATCHES_H
#include "interop.h"

SHARED_BEGIN

// A node of a patch tree. Nodes, charts, tiles and texels have indices over all objects.
struct PatchNode {
  // x: the first of its two children, 0: it is a leaf; y: 1 + its chart, 0: none;
  // inner nodes: z: split axis of the chart's frame, w: bits of the split position [m];
  // leaves: z: 1 + its tile, 0: none;
  // leaves in no chart: z: 1: lit by radiance transfer at vertices (renderer/prt), w: offset from a
  // vertex's index in the scene to its index among those vertices
  uvec4 branch;
};

struct PatchChart {
  vec4 origin;  // world space [m]
  vec4 tangent;
  vec4 bitangent;
};

struct PatchTile {
  vec4 frame;    // xy: its minimum corner in the chart's frame [m]; zw: texels per metre
  uvec4 texels;  // x: its first texel, y: columns, z: rows
};

// The surface of a pixel is described by one number, its place: 1 + 2 · leaf, plus 1 on the front
// of a leaf with a tile or of a triangle lit by radiance transfer; 0: nothing is hit. Each place
// has a list of lights.

// An entry of a list is the index of a VPL in the pass, plus this value if the tile already holds
// its light and only its shadow must be subtracted.
SHARED_CONST int kTakeShadow = 65536;

// With merged passes, the index of the entry's pass times this value is added, and the entries that
// need maps are sorted by pass.
SHARED_CONST int kPassUnit = 131072;
SHARED_CONST int kMostPasses = 32768;

SHARED_END
#endif
