// Estimates what a picture lacks from two noisy estimates that share no random numbers.
#pragma once

#include <functional>
#include <vector>

#include "renderer/path_repair/filter_sums.h"
#include "renderer/path_repair/path_sums.h"
#include "renderer/path_repair/repair_guides.h"
#include "renderer/path_repair/surface_mean.h"
#include "renderer/path_repair/window_residual.h"

namespace lamplighter {

// The residual, truth minus picture, is divided into bands of detail by a joint bilateral filter
// over normals, planes and albedo. Each band is weighed at each pixel by the share of its power
// that both halves have in common (Wiener); what one has alone is noise. The more paths, the more
// of the detail is shown: in the limit all. Where the noise hides a residual, the picture stays as
// it is, but for patterns of the picture that the paths around do not have at all.
class ResidualFilter {
 public:
  // What paths are an estimate of: the truth, or its difference to the picture.
  enum class Estimate : uint8_t { truth, residual };
  // All arguments must stay as they are until the filter is done.
  ResidualFilter(const RepairGuides& guides, const Image& live, const PathSums& sums,
                 Estimate estimate = Estimate::truth);
  ~ResidualFilter();
  ResidualFilter(const ResidualFilter&) = delete;
  ResidualFilter& operator=(const ResidualFilter&) = delete;

  // Goes through the picture many times, a number of rows in each call. Returns how many.
  bool isDone() const { return next_ == steps_.size(); }
  int step(int mostRows);
  // When it is done: by how much the picture differs from the truth in coarse bands, relative and
  // in the root mean square, as far as that is no noise.
  float error() const;
  // Once, when it is done: the residual [W/(m² sr)].
  Image takeResidual() { return std::move(residual_); }

 private:
  using Step = std::function<void(Rows)>;
  template <typename T>
  void planMeans(std::vector<T>& of, std::vector<T>& next, int step);
  void planTaming();
  void planBand(int band);
  void planPixels();

  vec3 known(size_t pixel) const;
  vec3 mean(size_t pixel) const;
  template <typename F>
  void forRows(Rows rows, const F& f) const;
  void begin(Rows rows);
  double weight(size_t pixel) const;
  void weighBorders(Rows rows);
  void addBorders(Rows rows);
  float borderShare(size_t pixel) const;
  void takeBounds(Rows rows);
  void tame(Rows rows);
  void beginBands(Rows rows);
  void takeDetail(int band, Rows rows);
  void takeBase(Rows rows);
  void weighBand(int band, Rows rows);
  void addBand(int band, Rows rows);
  void addWindow(Rows rows);
  void addPixels(Rows rows);
  float aloneness(size_t pixel) const;

  const RepairGuides& guides_;
  const Image& live_;
  const PathSums& paths_;
  Estimate estimate_;
  std::vector<Step> steps_;  // each for all rows
  size_t next_ = 0;
  int row_ = 0;  // from which on the next step is missing
  Image residual_;
  // Sums of squares of the picture and, for pixels that show surfaces, of the difference of the
  // halves.
  double light_ = 0.0, surfaceLight_ = 0.0, surfaceNoise_ = 0.0;
  double borderCommon_ = 0.0, borderPower_ = 0.0;  // of pixels that show no surface
  Evidence band_;                                  // of the last band, over the whole picture
  double error_ = 0.0;                             // its square, times the pixels
  float windowVariances_ = 0.0f;
  std::vector<Halves> tame_, smooth_, detail_;  // tame_: all light but single bright paths
  std::vector<vec3> smoothPicture_, pictureDetail_;
  std::vector<ResidualBounds> bounds_, nextBounds_;
  std::vector<ResidualSums> sums_, nextSums_;
  std::vector<BandPowers> powers_, nextPowers_;
  std::vector<BandNoise> noise_, nextNoise_;
  std::vector<float> variance_;      // of the last means, with that of a pixel 1
  std::vector<float> fineVariance_;  // after the fine bands
};

}  // namespace lamplighter
