// Filters the noise of gather rays at the samples, and replaces the light of buried samples.
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "renderer/surface_light/gather_links.h"

namespace lamplighter {

// Light is averaged over samples that share an element if everything that they see is far away
// compared with their distance, because irradiance varies little there. In corners and at contacts
// it is not filtered. Buried samples get the mean of their neighbours that are not buried,
// propagated from sample to sample.
class LightSmoothing {
 public:
  // Call after links of these samples changed. `isNewMesh`: all elements are new.
  void update(const RenderScene& scene, const SurfaceMesh& mesh, const GatherLinks& links,
              std::span<const uint32_t> changed, bool isNewMesh);

  // `values`: by sample; more values may follow. The fewer links are known, the stronger the
  // filter.
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
