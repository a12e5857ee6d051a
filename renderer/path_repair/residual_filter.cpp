#include "renderer/path_repair/residual_filter.h"

#include <algorithm>
#include <cmath>

#include "renderer/path_repair/surface_mean.h"

namespace lamplighter {
namespace {

constexpr int kBands = 6;
// Rounds of bounds on single bright pixels, and the largest step of the means that they are
// compared with.
constexpr int kTamings = 2, kTamingStep = 8;
// A difference between the halves so many times above the usual one around is bounded. Likewise a
// residual; that bound grows with the number of paths, so that the limit is exact.
constexpr float kMostDifference = 3.0f, kMostResidual = 3.0f, kPathsABound = 32.0f;
// What both halves have in common must be above the noise by so much [variances].
constexpr float kSure = 1.5f;
// A band is shown from the first number of paths behind a pixel on, and fully from three times as
// many on: before, two bright paths may meet by chance.
constexpr float kLeastPaths = 16.0f;
// Neighbours in a coarse band share paths: their mean has so much more variance than that of
// independent ones.
constexpr float kCorrelation = 1.78f;
// Pixels that show no surface, or a border of a lamp, take the mean of their paths, beside the live
// picture as so many paths: the shifted pictures that antialias it.
constexpr float kLivePaths = 16.0f;
// The noise around a pixel counts as so many pixels of the usual noise of the picture; with few
// paths as more, because paths that find nothing show no noise.
constexpr float kUsualPixels = 8.0f, kUsualPaths = 64.0f;

float squareOf(const vec3& v) { return glm::dot(v, v); }

}  // namespace

struct ResidualFilter::Halves {
  vec3 first{0.0f}, second{0.0f};
  vec3 mean() const { return 0.5f * (first + second); }
  vec3 half() const { return 0.5f * (first - second); }
};

// Residuals times albedo, and its square: their quotient is the residual of a white surface, by
// least squares.
struct ResidualFilter::Sums {
  Halves tame;
  vec3 excess{0.0f};  // of both halves: what was bounded, which only the widest mean gets
  vec3 squares{0.0f};
  float variance = 1.0f;  // of the mean, with the variance of a pixel 1

  static Sums nothing() { return {{}, vec3(0.0f), vec3(0.0f), 0.0f}; }
  void add(float w, const Sums& s) {
    tame.first += w * s.tame.first;
    tame.second += w * s.tame.second;
    excess += w * s.excess;
    squares += w * s.squares;
    variance += kCorrelation * w * w * s.variance;
  }
  void divide(float all) {
    const float scale = 1.0f / all;
    tame.first *= scale;
    tame.second *= scale;
    excess *= scale;
    squares *= scale;
    variance = std::min(variance * scale * scale, 1.0f);
  }
};

// Squares of the usual difference and of the usual residual, of a white surface.
struct ResidualFilter::Bounds {
  float difference = 0.0f, residual = 0.0f;

  static Bounds nothing() { return {}; }
  void add(float w, const Bounds& b) {
    difference += w * b.difference;
    residual += w * b.residual;
  }
  void divide(float all) {
    difference /= all;
    residual /= all;
  }
};

// Of a band: what both halves have in common, the power of their mean, its noise.
struct ResidualFilter::Powers {
  float common = 0.0f, mean = 0.0f, noise = 0.0f;
  float share = 1.0f;  // sum of squared weights: one by the number of independent pixels

  static Powers nothing() { return {0.0f, 0.0f, 0.0f, 0.0f}; }
  void add(float w, const Powers& p) {
    common += w * p.common;
    mean += w * p.mean;
    noise += w * p.noise;
    share += w * w * p.share;
  }
  void divide(float all) {
    common /= all;
    mean /= all;
    noise /= all;
    share /= all * all;
  }
};

struct ResidualFilter::Noise {
  float noise = 0.0f, share = 1.0f;

  static Noise nothing() { return {0.0f, 0.0f}; }
  void add(float w, const Noise& n) {
    noise += w * n.noise;
    share += w * w * n.share;
  }
  void divide(float all) {
    noise /= all;
    share /= all * all;
  }
};

ResidualFilter::ResidualFilter(const RepairGuides& guides, const Image& live, const Image& first,
                               const Image& second, int paths)
    : guides_(guides),
      live_(live),
      first_(first),
      second_(second),
      paths_(paths),
      residual_(guides.width, guides.height) {
  const size_t pixels = live.pixels.size();
  tame_.resize(pixels);
  bounds_.resize(pixels);
  nextBounds_.resize(pixels);
  powers_.resize(pixels);
  nextPowers_.resize(pixels);
  noise_.resize(pixels);
  nextNoise_.resize(pixels);
  const float scale = 2.0f / static_cast<float>(paths);
  steps_.push_back([this, scale] {
    forSurfaces(guides_, [&](int, int, size_t i) {
      tame_[i] = {scale * first_.pixels[i] - live_.pixels[i],
                  scale * second_.pixels[i] - live_.pixels[i]};
    });
    takeUsualNoise();
    takeBorders();
  });
  for (int round = 0; round < kTamings; ++round) {
    steps_.push_back([this] {
      forSurfaces(guides_, [&](int, int, size_t i) {
        const vec3& albedo = guides_.albedo[i];
        bounds_[i] = {squareOf(2.0f * tame_[i].half() / albedo),
                      squareOf(tame_[i].mean() / albedo)};
      });
    });
    for (int step = 1; step <= kTamingStep; step *= 2)
      steps_.push_back([this, step] {
        takeSurfaceMeans(guides_, bounds_, step, nextBounds_);
        bounds_.swap(nextBounds_);
      });
    steps_.push_back([this] { tame(); });
  }
  steps_.push_back([this] { beginBands(); });
  for (int band = 0; band <= kBands; ++band) {
    const int step = 1 << std::min(band, kBands - 1);
    if (band < kBands)
      steps_.push_back([this, step] {
        forSurfaces(guides_, [&](int, int, size_t i) { variance_[i] = sums_[i].variance; });
        takeSurfaceMeans(guides_, sums_, step, nextSums_);
        sums_.swap(nextSums_);
        takeDetail();
      });
    else
      steps_.push_back([this] { takeBase(); });
    for (const int wider : {1, 2})
      steps_.push_back([this, step, wider] {
        takeSurfaceMeans(guides_, powers_, wider * step, nextPowers_);
        powers_.swap(nextPowers_);
      });
    steps_.push_back([this, step] {
      beginNoise();
      takeSurfaceMeans(guides_, noise_, 4 * step, nextNoise_);
      noise_.swap(nextNoise_);
    });
    steps_.push_back([this] { addBand(); });
  }
}

ResidualFilter::~ResidualFilter() = default;

void ResidualFilter::step() { steps_[next_++](); }

void ResidualFilter::takeBorders() {
  const auto paths = static_cast<float>(paths_);
  for (size_t i = 0; i < live_.pixels.size(); ++i) {
    if (guides_.normal[i] != vec3(0.0f)) continue;
    const vec3 mean = (first_.pixels[i] + second_.pixels[i]) / paths;
    residual_.pixels[i] = paths / (paths + kLivePaths) * (mean - live_.pixels[i]);
  }
}

// Of a path for a pixel, by the square of the picture: over the whole picture.
void ResidualFilter::takeUsualNoise() {
  double noise = 0.0, live = 0.0;
  for (size_t i = 0; i < tame_.size(); ++i) {
    if (guides_.normal[i] == vec3(0.0f)) continue;
    noise += static_cast<double>(squareOf(tame_[i].half()));
    live += static_cast<double>(squareOf(live_.pixels[i]));
  }
  usualNoise_ = live > 0.0 ? static_cast<float>(noise / live) : 0.0f;
}

// Bounds what is far brighter in one half than in the other, and what is far brighter than all
// around it: single bright paths.
void ResidualFilter::tame() {
  const float mostResidual = kMostResidual + static_cast<float>(paths_) / kPathsABound;
  forSurfaces(guides_, [&](int, int, size_t i) {
    Halves& h = tame_[i];
    const vec3& albedo = guides_.albedo[i];
    const vec3 difference = 2.0f * h.half() / albedo;
    const float most = kMostDifference * kMostDifference * bounds_[i].difference;
    const float is = squareOf(difference);
    if (is > most) {
      const vec3 excess = (1.0f - std::sqrt(most / is)) * difference * albedo;
      h.first -= glm::max(excess, vec3(0.0f));
      h.second += glm::min(excess, vec3(0.0f));
    }
    const float mean = squareOf(h.mean() / albedo);
    const float mostMean = mostResidual * mostResidual * bounds_[i].residual;
    if (mean > mostMean) {
      const float scale = std::sqrt(mostMean / mean);
      h.first *= scale;
      h.second *= scale;
    }
  });
}

void ResidualFilter::beginBands() {
  bounds_ = {};
  nextBounds_ = {};
  sums_.resize(tame_.size());
  nextSums_.resize(tame_.size());
  variance_.resize(tame_.size());
  detail_.resize(tame_.size());
  const float scale = 1.0f / static_cast<float>(paths_);
  forSurfaces(guides_, [&](int, int, size_t i) {
    const vec3& albedo = guides_.albedo[i];
    const vec3 all = scale * (first_.pixels[i] + second_.pixels[i]) - live_.pixels[i];
    sums_[i] = {{albedo * tame_[i].first, albedo * tame_[i].second},
                albedo * (all - tame_[i].mean()),
                albedo * albedo,
                1.0f};
  });
  smooth_ = std::move(tame_);
}

// What the last means took away.
void ResidualFilter::takeDetail() {
  forSurfaces(guides_, [&](int, int, size_t i) {
    const vec3 scale = guides_.albedo[i] / sums_[i].squares;
    const Halves now{scale * sums_[i].tame.first, scale * sums_[i].tame.second};
    const Halves detail{smooth_[i].first - now.first, smooth_[i].second - now.second};
    smooth_[i] = now;
    detail_[i] = detail;
    powers_[i] = {glm::dot(detail.first, detail.second), squareOf(detail.mean()),
                  squareOf(detail.half()), 1.0f};
  });
}

// What is left: the mean over the whole surroundings, with all that was bounded.
void ResidualFilter::takeBase() {
  forSurfaces(guides_, [&](int, int, size_t i) {
    const vec3 excess = guides_.albedo[i] / sums_[i].squares * sums_[i].excess;
    variance_[i] = sums_[i].variance;
    detail_[i] = {smooth_[i].first + excess, smooth_[i].second + excess};
    powers_[i] = {glm::dot(detail_[i].first, detail_[i].second), squareOf(detail_[i].mean()),
                  squareOf(detail_[i].half()), 1.0f};
  });
}

void ResidualFilter::beginNoise() {
  forSurfaces(guides_, [&](int, int, size_t i) {
    noise_[i] = {powers_[i].noise, powers_[i].share};
  });
}

void ResidualFilter::addBand() {
  const auto paths = static_cast<float>(paths_);
  const float usualPixels = kUsualPixels + kUsualPaths / paths;
  forSurfaces(guides_, [&](int, int, size_t i) {
    const float usual = usualNoise_ * squareOf(live_.pixels[i]) * variance_[i];
    const float pixels = 1.0f / noise_[i].share;
    const float noise = (pixels * noise_[i].noise + usualPixels * usual) / (pixels + usualPixels);
    const Powers& p = powers_[i];
    if (!(p.mean > 0.0f)) return;
    const float shown = std::clamp(0.5f * (paths / variance_[i] / kLeastPaths - 1.0f), 0.0f, 1.0f);
    const float share = std::clamp((p.common - kSure * noise) / p.mean, 0.0f, 1.0f);
    residual_.pixels[i] += shown * share * detail_[i].mean();
  });
}

}  // namespace lamplighter
