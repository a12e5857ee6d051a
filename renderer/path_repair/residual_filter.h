// Estimates what a picture lacks from two noisy pictures of the truth that share no random numbers.
#pragma once

#include <functional>
#include <vector>

#include "renderer/image/image.h"
#include "renderer/path_repair/repair_guides.h"

namespace lamplighter {

// The residual, truth minus picture, is divided into bands of detail by a joint bilateral filter
// over normals, planes and albedo. Each band is weighed at each pixel by the share of its power
// that both halves have in common (Wiener); what one has alone is noise. The more paths, the more
// of the detail is shown: in the limit all. Where the noise hides a residual, the picture stays as
// it is.
class ResidualFilter {
 public:
  // `first`, `second`: sums of `paths` / 2 paths for each pixel. All arguments must stay as they
  // are until the filter is done.
  ResidualFilter(const RepairGuides& guides, const Image& live, const Image& first,
                 const Image& second, int paths);
  ~ResidualFilter();
  ResidualFilter(const ResidualFilter&) = delete;
  ResidualFilter& operator=(const ResidualFilter&) = delete;

  // The work is done in steps that take about the same time.
  bool isDone() const { return next_ == steps_.size(); }
  void step();
  // Once, when it is done: the residual [W/(m² sr)].
  Image takeResidual() { return std::move(residual_); }

 private:
  struct Halves;
  struct Sums;
  struct Bounds;
  struct Powers;
  struct Noise;
  void tame();
  void takeUsualNoise();
  void takeBorders();
  void beginBands();
  void takeDetail();
  void takeBase();
  void beginNoise();
  void addBand();

  const RepairGuides& guides_;
  const Image &live_, &first_, &second_;
  int paths_;
  std::vector<std::function<void()>> steps_;
  size_t next_ = 0;
  Image residual_;
  float usualNoise_ = 0.0f;
  std::vector<Halves> tame_, smooth_, detail_;
  std::vector<Bounds> bounds_, nextBounds_;
  std::vector<Sums> sums_, nextSums_;
  std::vector<Powers> powers_, nextPowers_;
  std::vector<Noise> noise_, nextNoise_;
  std::vector<float> variance_;
};

}  // namespace lamplighter
