// What each potential light sample brings to the view with what stands between, by rays, for a
// picture at rest. Segovia et al., "Bidirectional Instant Radiosity", 2006, choose samples by
// visibility, too; paper 2, section 8.2, compares with it.
#pragma once

#include <span>
#include <vector>

#include "renderer/imperfect_maps/bidirectional_importance.h"
#include "renderer/raycast/ray_caster.h"

namespace lamplighter {

class VisibleImportance {
 public:
  static constexpr int kRays = 8;  // of a texel

  // `importance`: B of each texel, for these samples.
  void restart(std::span<const float> importance);
  // Goes on with the next texels, by about so many rays; at least one column. Rays go to view
  // samples that are drawn in proportion to what the texel brings to them. In parallel; the result
  // depends neither on that nor on the steps. Returns the number of rays.
  uint64_t goOn(const ReflectiveMap& map, const ViewSamples& samples, float clampDistance,
                const RayCaster& rays, uint64_t mostRays);
  bool isDone(const ReflectiveMap& map) const { return column_ >= map.columns(); }
  // B times the share of the rays that arrive. Texels of which none arrives keep a little, since
  // few rays do not prove that none would.
  std::span<const float> importance() const { return importance_; }

 private:
  // `sums`: receives the running sum of what the texel brings to the samples.
  uint64_t see(const ReflectiveMap& map, const ViewSamples& samples, float clampDistance,
               const RayCaster& rays, size_t texel, std::vector<float>& sums);

  std::vector<float> importance_;
  int column_ = 0;  // the first one that is not done
};

}  // namespace lamplighter
