// Takes the noise of gather rays out of light at the samples, and replaces what buried samples see.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "renderer/surface_light/gather_links.h"

namespace lamplighter {

// Light is averaged over samples that share an element, where all that they see is far away
// compared with their distance: there irradiance varies little. In corners and at contacts it is
// kept. Buried samples get the mean of their neighbours that are not, from one to the next.
class LightSmoothing {
 public:
  // After links of these samples changed. `isNewMesh`: all elements are other ones.
  void update(const RenderScene& scene, const SurfaceMesh& mesh, const GatherLinks& links,
              std::span<const uint32_t> changed, bool isNewMesh);

  // `values`: by sample; more values may follow. The fewer links are known, the more it averages.
  void apply(const SurfaceMesh& mesh, std::vector<vec3>& values) const;
  // The same for values of the corners of elements, within each element.
  void fillCorners(const SurfaceMesh& mesh, std::vector<vec3>& corners) const;
  // The samples whose values apply() averages for one sample; the sum of their weights is 1.
  std::map<uint32_t, double> sharesOf(const SurfaceMesh& mesh, uint32_t sample) const;
  bool isBuried(uint32_t sample) const { return isBuried_[sample] != 0; }
  // GatherLinks::reachOf() of a sample.
  float reachOf(uint32_t sample) const { return reach_[sample]; }
  size_t bytes() const;

 private:
  // The neighbours of a sample, and the number of the first one in weights_.
  struct Near {
    std::span<const uint32_t> samples;  // within their object
    uint32_t firstSample = 0, first = 0;
  };
  static Near nearOf(const SurfaceMesh& mesh, uint32_t sample);
  void findWeights(const SurfaceMesh& mesh);
  void orderBuried(const SurfaceMesh& mesh);
  std::vector<vec3> positions_;    // by sample
  std::vector<float> reach_;       // by sample [m]
  std::vector<float> weights_;     // by neighbour: relative to that of the sample itself
  std::vector<uint8_t> isBuried_;  // by sample
  std::vector<uint32_t> fills_;    // buried samples, nearest to others first
  int passes_ = 0;
};

}  // namespace lamplighter
