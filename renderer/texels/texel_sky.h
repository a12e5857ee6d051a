// Visibility of the sky at each texel: one bit for each of a fixed set of directions, so that
// another sky needs no rays.
#pragma once

#include <functional>
#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/texels/texel_moves.h"

namespace lamplighter {

class TexelSky {
 public:
  void restart(size_t texels);
  // After objects moved: keeps the bits of directions that do not meet them.
  void outdate(TexelMoves moves);
  // Whether nothing blocks a direction (world space, unit length). Must be thread-safe.
  using Open = std::function<bool(uint32_t texel, const vec3& direction)>;
  // Tests up to about `most` more directions. Returns their number. The result does not depend on
  // `most`.
  uint64_t goOn(const TexelSet& texels, const Open& isOpen, uint64_t most);
  bool isDone() const { return next_ == count_; }
  size_t texels() const { return count_; }

  // Irradiance of each texel by the sky without suns, at unit brightness [W/m²].
  std::vector<vec3> light(const RenderScene& scene, const LightSet& lights,
                          const TexelSet& texels) const;
  size_t bytes() const { return bits_.size() * sizeof(uint64_t); }

 private:
  size_t count_ = 0, next_ = 0;  // number of texels; the first one that is not computed
  std::vector<uint64_t> bits_;   // kWords for each texel
  TexelMoves moves_;             // moves since the bits were complete; empty: no bits are known
};

}  // namespace lamplighter
