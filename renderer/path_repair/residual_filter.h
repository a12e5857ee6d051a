// Estimates the residual of a picture from two noisy estimates that share no random numbers.
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
// over normals, planes and albedo. Each band is weighted at each pixel by the share of its power
// that both halves have in common (Wiener filter); the rest is noise. More paths show more detail,
// in the limit all of it. Where the noise hides the residual, the picture does not change, except
// for patterns of the picture that the surrounding paths do not have.
class ResidualFilter {
 public:
  // What paths estimate: the truth, or its difference from the picture.
  enum class Estimate : uint8_t { truth, residual };
  // All arguments must stay valid and unchanged until the filter is done.
  ResidualFilter(const RepairGuides& guides, const Image& live, const PathSums& sums,
                 Estimate estimate = Estimate::truth);
  ~ResidualFilter();
  ResidualFilter(const ResidualFilter&) = delete;
  ResidualFilter& operator=(const ResidualFilter&) = delete;

  // Filters up to `mostRows` rows per call, in many passes over the picture. Returns the number of
  // rows.
  bool isDone() const { return next_ == steps_.size(); }
  int step(int mostRows);
  // When it is done: relative root mean square error of the picture in coarse bands, without the
  // part that may be noise.
  float error() const;
  // Call once, when it is done: returns the residual [W/(m² sr)].
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
  std::vector<Step> steps_;  // each step covers all rows
  size_t next_ = 0;
  int row_ = 0;  // first row without the next step
  Image residual_;
  // Sums of squares: of the picture; for pixels that show surfaces, of the picture and of half the
  // difference of the halves.
  double light_ = 0.0, surfaceLight_ = 0.0, surfaceNoise_ = 0.0;
  double borderCommon_ = 0.0, borderPower_ = 0.0;  // of pixels that show no surface
  Evidence band_;       // evidence of the last band, over the whole picture
  double error_ = 0.0;  // square of the error, times the number of pixels
  float windowVariances_ = 0.0f;
  std::vector<Halves> tame_, smooth_, detail_;  // tame_: all light except single bright paths
  std::vector<vec3> smoothPicture_, pictureDetail_;
  std::vector<ResidualBounds> bounds_, nextBounds_;
  std::vector<ResidualSums> sums_, nextSums_;
  std::vector<BandPowers> powers_, nextPowers_;
  std::vector<BandNoise> noise_, nextNoise_;
  std::vector<float> variance_;      // variance of the last means, if the variance of a pixel is 1
  std::vector<float> fineVariance_;  // after the fine bands
};

}  // namespace lamplighter
