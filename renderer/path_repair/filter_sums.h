// Per-pixel values that ResidualFilter averages (surface_mean.h).
#pragma once

#include <algorithm>

#include "renderer/base/math.h"
#include "renderer/path_repair/halves.h"

namespace lamplighter {

// Sums of residuals, of the picture and of albedo. Quotients by the last are means for a white
// surface, in which pixels count by albedo. Least squares would count by its square, but the noise
// of paths grows with albedo, too.
struct ResidualSums {
  // Neighbours in a coarse band share paths: their mean has a larger variance than that of
  // independent ones, by this factor.
  static constexpr float kCorrelation = 1.78f;

  Halves tame;
  // Of both halves: the part above the bound, which is added only to the widest mean.
  vec3 excess{0.0f};
  vec3 picture{0.0f};
  vec3 albedo{0.0f};
  float variance = 1.0f;  // variance of the mean, if the variance of one pixel is 1

  // Weight of a neighbour, at most 1: the mean of fewer pixels is noisier. Otherwise thin bars near
  // a wall leave copies of their noise on it, at the distance of a step.
  float trust(const ResidualSums& neighbour) const {
    return std::min(variance / neighbour.variance, 1.0f);
  }
  static ResidualSums nothing() { return {{}, vec3(0.0f), vec3(0.0f), vec3(0.0f), 0.0f}; }
  void add(float w, const ResidualSums& s) {
    tame.first += w * s.tame.first;
    tame.second += w * s.tame.second;
    excess += w * s.excess;
    picture += w * s.picture;
    albedo += w * s.albedo;
    variance += kCorrelation * w * w * s.variance;
  }
  void divide(float all) {
    const float scale = 1.0f / all;
    tame.first *= scale;
    tame.second *= scale;
    excess *= scale;
    picture *= scale;
    albedo *= scale;
    variance = std::min(variance * scale * scale, 1.0f);
  }
};

// Mean squares of the difference between the halves and of the residual, for a white surface.
struct ResidualBounds {
  float difference = 0.0f, residual = 0.0f;

  float trust(const ResidualBounds&) const { return 1.0f; }
  static ResidualBounds nothing() { return {}; }
  void add(float w, const ResidualBounds& b) {
    difference += w * b.difference;
    residual += w * b.residual;
  }
  void divide(float all) {
    difference /= all;
    residual /= all;
  }
};

// Powers of a band of the residual: common to both halves, of their mean, and of the noise of the
// mean.
struct BandPowers {
  float common = 0.0f, mean = 0.0f, noise = 0.0f;
  float share = 1.0f;  // sum of squared weights: the reciprocal of the number of independent pixels
  // Mean over the pixels of the common share of power, -1 to 1, in which single bright paths have
  // no larger weight than others.
  float agreement = 0.0f;
  // The power of the same band of the picture, and its scalar product with the residual.
  float picture = 0.0f, withPicture = 0.0f;

  BandPowers() = default;
  explicit BandPowers(const Halves& detail, const vec3& ofPicture = vec3(0.0f))
      : common(glm::dot(detail.first, detail.second)),
        mean(glm::dot(detail.mean(), detail.mean())),
        noise(glm::dot(detail.half(), detail.half())),
        agreement(mean + noise > 0.0f ? common / (mean + noise) : 0.0f),
        picture(glm::dot(ofPicture, ofPicture)),
        withPicture(glm::dot(ofPicture, detail.mean())) {}

  float trust(const BandPowers&) const { return 1.0f; }
  static BandPowers nothing() {
    BandPowers p;
    p.share = 0.0f;
    return p;
  }
  void add(float w, const BandPowers& p) {
    common += w * p.common;
    mean += w * p.mean;
    noise += w * p.noise;
    share += w * w * p.share;
    agreement += w * p.agreement;
    picture += w * p.picture;
    withPicture += w * p.withPicture;
  }
  void divide(float all) {
    const float scale = 1.0f / all;
    common *= scale;
    mean *= scale;
    noise *= scale;
    share *= scale * scale;
    agreement *= scale;
    picture *= scale;
    withPicture *= scale;
  }
};

struct BandNoise {
  float noise = 0.0f, share = 1.0f;  // as BandPowers

  float trust(const BandNoise&) const { return 1.0f; }
  static BandNoise nothing() { return {0.0f, 0.0f}; }
  void add(float w, const BandNoise& n) {
    noise += w * n.noise;
    share += w * w * n.share;
  }
  void divide(float all) {
    noise /= all;
    share /= all * all;
  }
};

}  // namespace lamplighter
