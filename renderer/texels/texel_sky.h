// Which parts of the sky each texel sees: a bit for each of many directions, so that another sky
// needs no ray.
#pragma once

#include <functional>
#include <vector>

#include "renderer/sampling/vpl_set.h"
#include "renderer/texels/texel_moves.h"

namespace lamplighter {

class TexelSky {
 public:
  void restart(size_t texels);
  // After objects moved: directions that do not meet them stay as they are.
  void outdate(TexelMoves moves);
  // Whether nothing is in a direction (world space, unit); called by several threads.
  using Open = std::function<bool(uint32_t texel, const vec3& direction)>;
  // Tests about `most` directions more. Returns their number. The result does not depend on it.
  uint64_t goOn(const TexelSet& texels, const Open& isOpen, uint64_t most);
  bool isDone() const { return next_ == count_; }
  size_t texels() const { return count_; }

  // Irradiance of each texel by the sky without its suns, at unit brightness [W/m²].
  std::vector<vec3> light(const RenderScene& scene, const LightSet& lights,
                          const TexelSet& texels) const;
  size_t bytes() const { return bits_.size() * sizeof(uint64_t); }

 private:
  size_t count_ = 0, next_ = 0;  // texels, and the first one that is not known
  std::vector<uint64_t> bits_;   // kWords for each texel
  TexelMoves moves_;             // since the bits were complete; empty: bits are not known
};

}  // namespace lamplighter
