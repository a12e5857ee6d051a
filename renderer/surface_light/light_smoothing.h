// Takes the noise of gather rays out of light at the samples, and replaces what buried samples see.
#pragma once

#include <cstdint>
#include <vector>

#include "renderer/surface_light/gather_links.h"

namespace lamplighter {

// Light is averaged over samples that share an element, where all that they see is far away
// compared with their distance: there irradiance varies little. In corners and at contacts it is
// kept. Buried samples get the mean of their neighbours that are not, from one to the next.
class LightSmoothing {
 public:
  LightSmoothing() = default;
  LightSmoothing(const RenderScene& scene, const SurfaceMesh& mesh, const GatherLinks& links);

  // `values`: by sample; more values may follow.
  void apply(std::vector<vec3>& values) const;
  // The same for values of the corners of elements, within each element.
  void fillCorners(const SurfaceMesh& mesh, std::vector<vec3>& corners) const;
  bool isBuried(uint32_t sample) const { return isBuried_[sample] != 0; }
  size_t bytes() const;

 private:
  struct Neighbour {
    uint32_t sample;
    float weight;  // relative to that of the sample itself
  };
  void findNeighbours(const SurfaceMesh& mesh);
  void orderBuried();
  std::vector<uint32_t> starts_;  // by sample: its first neighbour
  std::vector<Neighbour> neighbours_;
  std::vector<uint8_t> isBuried_;  // by sample
  std::vector<uint32_t> fills_;    // buried samples, nearest to others first
};

}  // namespace lamplighter
