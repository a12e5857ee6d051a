// Binding points of the gl backend's shaders. Textures, uniform blocks, storage blocks and vertex
// attributes have separate numbers.
#ifndef LAMPLIGHTER_SHARED_BINDINGS_H
#define LAMPLIGHTER_SHARED_BINDINGS_H
#include "interop.h"

SHARED_BEGIN

SHARED_CONST int kVplBlock = 0;
SHARED_CONST int kMaterialBlock = 1;

SHARED_CONST int kPositionBuffer = 0;
SHARED_CONST int kIndexBuffer = 1;
SHARED_CONST int kUv0Buffer = 2;
SHARED_CONST int kUv1Buffer = 3;

// Different passes reuse the same numbers: OpenGL guarantees only eight.
SHARED_CONST int kRootBuffer = 0;  // by triangle of the scene: the root node of its patch tree
SHARED_CONST int kPatchBuffer = 1;
SHARED_CONST int kChartBuffer = 2;
SHARED_CONST int kTileBuffer = 3;
SHARED_CONST int kTexelBuffer = 4;
// In addition, in the pass that finds patches:
SHARED_CONST int kCornerBuffer = 5;       // by triangle of the scene: its three vertices
SHARED_CONST int kPlaceBuffer = 6;        // positions of vertices
SHARED_CONST int kVertexLightBuffer = 7;  // patches.h
// in addition, in the sum:
SHARED_CONST int kListRangeBuffer = 5;
SHARED_CONST int kListBuffer = 6;
// In the pass over the cells of the low-resolution pass:
SHARED_CONST int kHardPlaceBuffer = 0;  // by place, 1: a hard shadow may lie there
// In addition, where all lights are summed everywhere, and in that pass:
// by triangle of the scene: one bit per link (light_linking.h)
SHARED_CONST int kLeftOutBuffer = 1;

// Bindings of prefix sums and cumulative distributions (renderer/gl/scan.h). Rows of the sums and
// shares have one more entry than the values.
SHARED_CONST int kScanValues = 0;
SHARED_CONST int kScanSums = 1;
SHARED_CONST int kScanGroupSums = 2;  // by row and work group: the sum of its values
SHARED_CONST int kScanOffsets = 3;    // by row and work group: the sum before it
SHARED_CONST int kScanShares = 4;     // the sums divided by the total
SHARED_CONST int kScanTotals = 5;     // by row
SHARED_CONST int kScanGroup = 256;    // invocations of a work group

SHARED_CONST int kPositionAttribute = 0;
SHARED_CONST int kNormalAttribute = 1;
SHARED_CONST int kTangentAttribute = 2;
SHARED_CONST int kUv0Attribute = 3;
SHARED_CONST int kUv1Attribute = 4;
SHARED_CONST int kColorAttribute = 5;
SHARED_CONST int kFirstIndexAttribute = 6;  // one per object: the start of its indices

// In passes over whole pictures (picture_passes.h):
SHARED_CONST int kPicture = 0;
SHARED_CONST int kOtherPicture = 1;

SHARED_CONST int kBaseColorTexture = 0;
SHARED_CONST int kNormalTexture = 1;
SHARED_CONST int kEmissiveTexture = 2;
SHARED_CONST int kGlossTexture = 3;

// Outputs of the G-buffer pass and inputs of other passes, in this order.
// xyz: world position [m]; w: 0 where nothing was hit, else a float with the bits kTriangleBits +
// the triangle's index in the scene
SHARED_CONST int kGPosition = 0;
SHARED_CONST int kGNormals = 1;  // octahedral: xy shading, zw geometric, on the side of the eye
// a: 0 where nothing was hit; normals and emission are undefined there
SHARED_CONST int kGAlbedo = 2;
SHARED_CONST int kGEmission = 3;    // towards the eye [W/(m² sr)]
SHARED_CONST int kGlossTarget = 4;  // output of that pass; other passes read it as kGGloss
SHARED_CONST int kShadowMaps = 4;
SHARED_CONST int kIrradiance = 5;
SHARED_CONST int kPlaces = 6;     // of pixels: patches.h
SHARED_CONST int kSamples = 7;    // irradiance at the samples of the low-resolution pass
SHARED_CONST int kCells = 8;      // of the low-resolution pass; 1: interpolated
SHARED_CONST int kVplTexels = 9;  // the data of kVplBlock as a buffer texture
SHARED_CONST int kSkyPicture = 10;
SHARED_CONST int kContrasts = 11;  // by cell, 1: the light differs much between its corners
SHARED_CONST int kGGloss = 12;     // x: metallic, y: roughness; undefined where nothing was hit
SHARED_CONST int kSpeculars = 13;  // specular radiance towards the eye [W/(m² sr)]

// The smallest normal float, so that no triangle index becomes a denormal, an infinity or a NaN.
SHARED_CONST int kTriangleBits = 8388608;

SHARED_END
#endif
