// The contribution of each potential light sample to the view with occlusion, by rays, for a
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
  static constexpr int kRays = 8;  // per texel

  // `importance`: B by texel, for the samples of the following calls.
  void restart(std::span<const float> importance);
  // Continues with the next texels, by about `mostRays` rays, but at least one column. Rays go to
  // view samples that are drawn in proportion to the contribution of the texel to them. The result
  // depends neither on the number of threads nor on `mostRays`. Returns the number of rays.
  uint64_t goOn(const ReflectiveMap& map, const ViewSamples& samples, float clampDistance,
                const RayCaster& rays, uint64_t mostRays);
  bool isDone(const ReflectiveMap& map) const { return column_ >= map.columns(); }
  // B times the share of unblocked rays. Texels without an unblocked ray keep a small value,
  // because few rays do not prove full occlusion.
  std::span<const float> importance() const { return importance_; }

 private:
  // `sums`: receives the running sum of the contributions of the texel to the samples.
  uint64_t see(const ReflectiveMap& map, const ViewSamples& samples, float clampDistance,
               const RayCaster& rays, size_t texel, std::vector<float>& sums);

  std::vector<float> importance_;
  int column_ = 0;  // the first one that is not done
};

}  // namespace lamplighter
