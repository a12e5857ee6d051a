// Depth maps of all directions at each texel of the surface, compressed along runs of neighbouring
// texels: they answer visibility between any texel and any point without a ray (paper 3, "Coherent
// surface shadow maps").
//
// Area lights block nothing, so that they can move freely.
//
// The value of a pixel lies between the first surface and the next one that faces the texel, so it
// is correct for every point on a surface that the texel might light. Depths are distances from the
// texel in 65,534 steps of the diameter of the scene.
#pragma once

#include <vector>

#include "renderer/raycast/ray_caster.h"
#include "renderer/surface_depths/depth_intervals.h"
#include "renderer/texels/depth_map_layout.h"
#include "renderer/texels/texel_set.h"

namespace lamplighter {

class SurfaceDepths {
 public:
  // Discards all depths. Runs do not cross objects or the two sides of an object.
  void restart(const RenderScene& scene, const TexelSet& texels, const DepthMapLayout& layout);
  // Traces up to about `most` more rays. Returns their number. The result does not depend on `most`
  // or on the number of threads. `scene` and `texels` must be those of restart().
  uint64_t goOn(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels,
                uint64_t most);
  bool isDone() const { return nextUnit_ == units(); }
  // For files: all results of goOn(). restore() fills the depths after restart(); it returns false
  // and changes nothing if the bytes do not match these texels.
  std::vector<uint8_t> saved() const;
  bool restore(std::span<const uint8_t> bytes);

  // Share of the work that is done, from 0 to 1.
  float progress() const;

  // Whether nothing blocks the line between the texel and a point of a surface (world space). False
  // below the horizon of the texel.
  bool sees(const SurfaceTexel& texel, size_t number, const vec3& point) const;
  // Whether the texel sees the sky in the direction of a pixel.
  bool isOpen(size_t texel, uint32_t pixel) const { return valueOf(texel, pixel) == kOpen; }
  static constexpr uint16_t kOpen = 0xffffu;
  uint16_t valueOf(size_t texel, uint32_t pixel) const;

  // Number of segments of the run of a texel, divided by the pixels of all its maps: 1 if nothing
  // is compressed.
  float segmentShareOf(size_t texel) const;
  // Whether all pixels of a texel are computed.
  bool isFound(size_t texel) const { return (runOf_[texel] + 1) * blocks() <= nextUnit_; }

  const DepthMapLayout& layout() const { return layout_; }
  size_t segments() const;
  // Number of pixels of all maps, without compression.
  size_t uncompressed() const { return texels_ * layout_.pixels(); }
  size_t bytes() const;

  // A run: `count` texels from `first`. The segments of pixel q are [starts[q], starts[q + 1]).
  struct Run {
    uint32_t first = 0, count = 0;
    std::vector<uint32_t> starts;
    DepthSegments segments;
  };
  std::span<const Run> runs() const { return runs_; }
  // Depth steps per metre.
  float steps() const { return steps_; }

 private:
  size_t blocks() const;  // number of blocks of pixels
  size_t units() const { return runs_.size() * blocks(); }
  uint64_t trace(const RenderScene& scene, const RayCaster& rays, const TexelSet& texels,
                 const Run& run, uint32_t pixel, std::vector<DepthInterval>& out) const;

  DepthMapLayout layout_;
  float steps_ = 1.0f;  // per metre
  std::vector<Run> runs_;
  std::vector<uint32_t> runOf_;  // by texel
  size_t texels_ = 0;
  size_t nextUnit_ = 0;  // runs times blocks of pixels
};

}  // namespace lamplighter
