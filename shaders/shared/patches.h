// Patches and their light maps (renderer/patches, renderer/light_maps) as the gl backend's shaders
// take them.
#ifndef LAMPLIGHTER_SHARED_PATCHES_H
#define LAMPLIGHTER_SHARED_PATCHES_H
#include "interop.h"

SHARED_BEGIN

// A node of a patch tree. Nodes, charts, tiles and texels of all objects are numbered through.
struct PatchNode {
  uvec4 branch;  // x: the first of its two children, 0: it is a leaf; y: 1 + its chart, 0: none;
                 // branches: z: axis of the chart's frame, w: bits of where it is split [m];
                 // leaves: z: 1 + its tile, 0: none;
                 // in no chart: z: 1: lit by transfer at vertices (renderer/prt), w: what to add to
                 // a vertex's number in the scene for its number among those
};

struct PatchChart {
  vec4 origin;  // world space [m]
  vec4 tangent;
  vec4 bitangent;
};

struct PatchTile {
  vec4 frame;    // xy: its least corner in the chart's frame [m]; zw: texels a metre
  uvec4 texels;  // x: its first texel, y: columns, z: rows
};

// What is known of a pixel's surface is one number, its place: 1 + 2 · the leaf, and 1 more on the
// front of a leaf with a tile or of a triangle lit by transfer; 0: nothing is hit. Each has a list of lights.

// A list's entry is a VPL's number in the pass, and this when its light is in the tile already and
// only its shadow is to be taken away.
SHARED_CONST int kTakeShadow = 65536;

// Where passes are merged, the number of the entry's pass times this is added, and those that need
// their maps stand in the order of their passes.
SHARED_CONST int kPassUnit = 131072;
SHARED_CONST int kMostPasses = 32768;

SHARED_END
#endif
