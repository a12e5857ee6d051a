// What each texel sees in each direction of the light field, its partner: the texel that sends
// light from there, or the sky. Computed once for a geometry, along grids of lines or by rays, and
// stored, so that edits of light need no visibility tests.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "renderer/light_field/field_directions.h"
#include "renderer/light_field/line_raster.h"

namespace lamplighter {

// A point of the surface that receives light on its front.
struct FieldReceiver {
  vec3 position{0.0f}, origin{0.0f};  // origin: of rays, off the surface
  vec3 normal{0.0f};                  // smooth
  vec3 geometricNormal{0.0f};
  uint32_t object = 0;
  bool isBack = false;    // of the object
  bool seesSky = true;    // false: light linking excludes it from the sky
  bool isBuried = false;  // it receives no light
};

// How partners are found. lines: the next crossing of the line of the receiver's cell (paper 5);
// cost grows with the number of triangles. rays: exact.
enum class FieldSight : uint8_t { lines, rays };

// Everything that partners depend on.
struct FieldGeometry {
  const RenderScene& scene;
  const RayCaster& rays;
  std::span<const ObjectAtlas> atlases;  // by object
  const FieldSurface& surface;
  std::span<const FieldReceiver> receivers;
  const FieldDirections& directions;
  uint32_t set = 0;    // number of the set of directions; each set has different grids
  float cell = 0.25f;  // side of the cells of lines [m]
  FieldSight sight = FieldSight::lines;
  bool withLamps = false;  // as the surface
};

// A partner is the number of a texel, or a larger number: the sky at the end of a direction, the
// sky at its opposite end, darkness, or a place on an area light.
struct PartnerNumbers {
  uint32_t texels = 0, directions = 0;
  uint32_t sky(size_t direction, bool isOpposite) const {
    return texels + static_cast<uint32_t>(direction) + (isOpposite ? directions : 0);
  }
  uint32_t dark() const { return texels + 2 * directions; }
  uint32_t lamp(uint32_t place) const { return dark() + 1 + place; }
  // The partner for a result of FieldSurface::texelAt().
  uint32_t of(uint32_t texel) const {
    if (texel == FieldSurface::kNone) return dark();
    return texel < FieldSurface::kLamps ? texel : lamp(texel - FieldSurface::kLamps);
  }
};

// The grid of lines of a direction.
LineGrid gridOf(const FieldGeometry& geometry, size_t direction);

struct PartnerCounts {
  uint64_t crossings = 0, samples = 0, rays = 0;
  void add(const PartnerCounts& other) {
    crossings += other.crossings;
    samples += other.samples;
    rays += other.rays;
  }
};

// Output array for the partners of all receivers in a direction.
struct PartnerTarget {
  uint32_t direction = 0;
  uint32_t* partners = nullptr;  // by receiver
};

// Finds the partners of some directions; `rasters`: one per direction. Uses all threads; the result
// does not depend on their number.
PartnerCounts findPartners(const FieldGeometry& geometry, std::span<const PartnerTarget> rows,
                           std::span<LineRaster> rasters);

}  // namespace lamplighter
