// Where the gl backend binds what its shaders read. Textures, uniform blocks, storage blocks and
// vertex attributes are numbered apart.
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

// Other passes use other buffers; eight numbers are all that OpenGL promises.
SHARED_CONST int kRootBuffer = 0;  // by triangle of the scene: the root of its patch tree
SHARED_CONST int kPatchBuffer = 1;
SHARED_CONST int kChartBuffer = 2;
SHARED_CONST int kTileBuffer = 3;
SHARED_CONST int kTexelBuffer = 4;
// With these in the pass that begins pixels,
SHARED_CONST int kCornerBuffer = 5;       // by triangle of the scene, three: its vertices
SHARED_CONST int kPlaceBuffer = 6;        // of vertices
SHARED_CONST int kVertexLightBuffer = 7;  // patches.h
// with these in the sum.
SHARED_CONST int kListRangeBuffer = 5;
SHARED_CONST int kListBuffer = 6;
// with this in the pass over cells of the low-resolution pass.
SHARED_CONST int kHardPlaceBuffer = 0;  // by place, 1: a hard shadow may lie there
// with this where all lights are summed everywhere, and in that pass.
SHARED_CONST int kLeftOutBuffer = 1;  // by triangle of the scene: a bit for each link (light_linking.h)

SHARED_CONST int kPositionAttribute = 0;
SHARED_CONST int kNormalAttribute = 1;
SHARED_CONST int kTangentAttribute = 2;
SHARED_CONST int kUv0Attribute = 3;
SHARED_CONST int kUv1Attribute = 4;
SHARED_CONST int kColorAttribute = 5;
SHARED_CONST int kFirstIndexAttribute = 6;  // one an object: where its indices begin

SHARED_CONST int kBaseColorTexture = 0;
SHARED_CONST int kNormalTexture = 1;
SHARED_CONST int kEmissiveTexture = 2;
SHARED_CONST int kGlossTexture = 3;

// What the G-buffer's pass writes and the others read, in this order.
SHARED_CONST int kGPosition = 0;  // xyz: world [m]; w: 0 where nothing was hit, else the bits of a
                                  // float: kTriangleBits + the number of the scene's triangle
SHARED_CONST int kGNormals = 1;   // octahedral: xy shading, zw geometric, on the side of the eye
SHARED_CONST int kGAlbedo = 2;    // a: 0 where nothing was hit, and normals and emission are void
SHARED_CONST int kGEmission = 3;  // towards the eye [W/(m² sr)]
SHARED_CONST int kGlossTarget = 4;  // in that pass; others read it as kGGloss
SHARED_CONST int kShadowMaps = 4;
SHARED_CONST int kIrradiance = 5;
SHARED_CONST int kPlaces = 6;     // of pixels: patches.h
SHARED_CONST int kSamples = 7;    // irradiance at those of the low-resolution pass
SHARED_CONST int kCells = 8;      // of the low-resolution pass: 1: interpolated
SHARED_CONST int kVplTexels = 9;  // kVplBlock's as a buffer texture
SHARED_CONST int kSkyPicture = 10;
SHARED_CONST int kContrasts = 11;  // of cells, 1: the light differs much between their corners
SHARED_CONST int kGGloss = 12;     // x: metallic, y: roughness; void where nothing was hit
SHARED_CONST int kSpeculars = 13;  // what the lobes give the eye [W/(m² sr)]

// The least normal float: no triangle's number becomes a denormal, an infinity or no number.
SHARED_CONST int kTriangleBits = 8388608;

SHARED_END
#endif
