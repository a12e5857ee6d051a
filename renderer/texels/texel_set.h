// The surface of a scene as texels: squares of about equal size in the charts of each object (paper
// 3, "Coherent surface shadow maps", section 3.2.3: the atlas).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "renderer/services/object_charts.h"
#include "renderer/surface_light/surface_mesh.h"

namespace lamplighter {

// World space.
struct SurfaceTexel {
  uint32_t object = 0;
  uint32_t chart = 0;  // of the object
  glm::ivec2 at{0};    // in the rectangle of the object
  SurfacePlace place;  // of the position
  // Points spread over its area, for means of properties that vary on the surface.
  std::array<SurfacePlace, 4> spread;
  SurfaceSpot spot;          // where light arrives
  std::array<vec3, 2> half;  // half edge vectors of a rectangle in its plane, of equal area
  float area = 0.0f;         // [m²]

  // That rectangle, a square inside of a chart; counter-clockwise as seen from the front.
  std::array<vec3, 4> square() const {
    const vec3& p = spot.position;
    return {p - half[0] - half[1], p + half[0] - half[1], p + half[0] + half[1],
            p - half[0] + half[1]};
  }
};

// Key for random numbers, independent of the index of the texel.
uint32_t seedOf(const SurfaceTexel& texel);

// Order in which the texels of an object are numbered. Within a chart, zigzag: rows alternately to
// the right and to the left; spiral: along the border and inwards; the next chart is the one
// nearest to the end of the last. greedy: always the nearest texel, in any chart (paper 3, section
// 3.2.3).
enum class TexelOrder : uint8_t { zigzag, spiral, greedy };

// A point of the surface between up to four texels.
struct TexelBlend {
  std::array<uint32_t, 4> texels{};
  std::array<float, 4> weights{};  // the sum is 1; 0 if there is no texel

  bool isAny() const {
    return weights[0] > 0.0f || weights[1] > 0.0f || weights[2] > 0.0f || weights[3] > 0.0f;
  }
};

class TexelSet {
 public:
  static constexpr uint32_t kNone = 0xffffffffu;

  TexelSet() = default;
  // Builds the texels of all objects that have an atlas: of their front, and of their back if the
  // material is double-sided.
  TexelSet(const RenderScene& scene, std::span<const ObjectAtlas> atlases, TexelOrder order);

  // One side of an object; its texels have consecutive numbers.
  struct Part {
    uint32_t first = 0, count = 0;
    glm::ivec2 size{0};
    std::vector<uint32_t> texelAt;  // by row and column of the rectangle; kNone
  };
  std::span<const Part> parts() const { return parts_; }
  size_t size() const { return texels_.size(); }
  const SurfaceTexel& operator[](size_t texel) const { return texels_[texel]; }

  // Finds buried texels, which lie inside an object or behind a wall: several of their rays hit
  // nearby backs of single-sided surfaces. Returns the number of rays.
  uint64_t findBuried(const RenderScene& scene, const RayCaster& rays);
  bool isBuried(size_t texel) const { return !isBuried_.empty() && isBuried_[texel] != 0; }

  // The texel at a point of a side of an object, given in texels of its rectangle; kNone if there
  // is none.
  uint32_t texelAt(uint32_t object, bool isBack, const vec2& texels) const;
  // Bilinear weights at a point of a side of an object, given in texels of its rectangle. Missing
  // texels are left out, and buried ones if there are others.
  TexelBlend blendAt(uint32_t object, bool isBack, const vec2& texels) const;

 private:
  TexelBlend blendOf(const Part& part, const vec2& texels, bool withBuried) const;

  std::vector<SurfaceTexel> texels_;
  std::vector<uint8_t> isBuried_;  // by texel; empty: not known
  std::vector<Part> parts_;        // the front and the back of each object
};

}  // namespace lamplighter
