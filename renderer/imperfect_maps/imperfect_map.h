// Imperfect shadow maps: the scene as points, rasterised into the octahedral hemisphere map of a
// light sample (paper 2, sections 3.3 and 5; Ritschel et al., "Imperfect Shadow Maps for Efficient
// Computation of Indirect Illumination", 2008).
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "renderer/base/math.h"
#include "shaders/shared/vpl.h"

namespace lamplighter {

// How a point is drawn.
enum class SplatShape : uint8_t {
  billboard,  // a disc that faces the light, as published
  tilted      // a disc on the surface: its depth is that of the plane at each texel
};
// How texels that no point covers are filled.
enum class HoleFilling : uint8_t {
  none,
  pullPush,  // means of larger and larger neighbourhoods, as published
  planes     // only where points on both sides lie on one plane
};

struct ImperfectMapOptions {
  int resolution = 64;  // texels per side, a power of two
  SplatShape splats = SplatShape::tilted;
  HoleFilling fill = HoleFilling::planes;
  bool operator==(const ImperfectMapOptions&) const = default;
};

// Points on the surfaces in world space, as a structure of arrays. The arrays are readable up to
// the next multiple of 8.
struct OccluderSpan {
  const float* x = nullptr;
  const float* y = nullptr;
  const float* z = nullptr;  // [m]
  const float* nx = nullptr;
  const float* ny = nullptr;
  const float* nz = nullptr;    // unit
  const float* area = nullptr;  // area of the surface that the point represents [m²]; 0: no point
  size_t count = 0;
};

// Whether a map from render(), of any resolution, puts a point in shadow. `at`, `normal`: the point
// and the normal of its surface on the lit side, in world space. `bias`: share of the distance.
bool isInShadow(const shared::Vpl& light, std::span<const float> map, const vec3& at,
                const vec3& normal, float bias);

struct SplatBatch;

// Draws one map at a time. Use one object per thread.
class ImperfectMap {
 public:
  explicit ImperfectMap(const ImperfectMapOptions& options);

  // The map of an oriented light: resolution² texels with 1/w of the nearest occluder, 0 without
  // one, as vpl_shading.h defines them. Valid until the next call.
  std::span<const float> render(const shared::Vpl& light, const OccluderSpan& points);
  // Whether the texel of the last map was filled and is not covered by a point.
  bool isFilled(size_t texel) const { return texels_[texel] > 0.0f && point_[texel] == kNone; }

 private:
  static constexpr uint32_t kNone = 0xffffffffu;
  void draw(const SplatBatch& batch, size_t lane, uint32_t point);
  void fillPlanes();
  void fillHole(size_t texel);
  void pullPush();

  ImperfectMapOptions options_;
  size_t side_;
  std::vector<float> texels_;
  std::vector<uint32_t> point_;               // by texel: the occluder, or kNone
  std::vector<float> ex_, ey_, ez_, e2_;      // the points of w = 1 at the texels' centres
  std::array<std::vector<float>, 3> planes_;  // by drawn point: 1/w at e is plane·e
  std::vector<std::vector<float>> pyramid_;   // of pull-push
};

}  // namespace lamplighter
