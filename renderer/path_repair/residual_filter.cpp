#include "renderer/path_repair/residual_filter.h"

#include <algorithm>
#include <cmath>

#include "renderer/path_repair/surface_mean.h"

namespace lamplighter {
namespace {

constexpr int kBands = 6;
// Number of passes that bound single bright pixels, and the largest step of the means with which
// they are compared.
constexpr int kTamings = 2, kTamingStep = 8;
// Differences between the halves are bounded to this multiple of the usual difference around the
// pixel, and residuals to a multiple of the usual residual; the latter bound grows with the number
// of paths, so that the limit is exact.
constexpr float kMostDifference = 3.0f, kMostResidual = 3.0f, kPathsABound = 32.0f;
// Thresholds of the common signal of both halves: how much it must exceed the noise [variances],
// and how many pixels with the usual noise of the picture are added to the noise around a pixel.
// Fine bands need larger thresholds, because two bright paths at one pixel by chance are visible as
// a spot. The error of known light is smooth.
struct Doubt {
  float variances, usualPixels;
};
constexpr Doubt kFineDoubt{2.0f, 4.0f}, kCoarseDoubt{0.75f, 2.0f}, kResidualDoubt{1.0f, 4.0f};
constexpr int kFineBands = 3;
// With few paths, more pixels with the usual noise are added: paths that find no light have no
// noise.
constexpr float kUsualPaths = 64.0f;
// Minimum number of paths behind a pixel to show a band; it is fully shown with three times as
// many. With fewer paths, two bright ones may agree by chance.
constexpr float kLeastPaths = 16.0f;
// Pixels that are far darker than the mean of the picture count less in sums over it.
constexpr double kDark = 0.01;
// The thresholds above are for pictures with small errors. If the halves agree in a coarse band by
// this share (Evidence), the error is large: then this fraction of the variances is enough, no
// usual noise is added, and fewer paths are enough. Not in fine bands, whose noise is visible as
// grain.
constexpr float kWrong = 0.1f, kWrongVariances = 0.3f, kWrongPaths = 4.0f;
// In fine bands the halves are trusted where the surrounding pixels agree by this much, minus the
// agreement by chance: three standard deviations of the agreement of one pixel. Then the thresholds
// for large errors apply. Not with fewer paths behind a pixel, because paths that find no light
// agree, too.
constexpr float kAgreement = 0.3f, kByChance = 1.8f, kAgreePaths = 4.0f;
// The slope of the residual over the picture must exceed its noise by this much [variances].
constexpr float kSlopeVariances = 9.0f;
// Radius of the window that weights borders [pixels], and by how many variances the halves must
// agree in it.
constexpr int kBorderRadius = 2;
constexpr float kBorderVariances = 2.0f;
// The remaining residual of a pixel after all bands must exceed this many of its variances, and
// more if these are known from few groups of paths.
constexpr float kSurePixel = 9.0f, kFewGroups = 10.0f;
// Pixels whose mean after the fine bands still has this share of their noise have few neighbours
// that show the same surface: leaves, legs of chairs, edges. Above twice that share, fewer
// variances are enough for their own paths.
constexpr float kAlone = 0.1f, kSureAlone = 2.0f;
// Approximate number of paths of all pixels of their window together.
constexpr float kWindowSamples = 600.0f;
constexpr int kLeastRadius = 2, kMostRadius = 8;  // of the window [pixels]
// With fewer paths, these pixels are scaled like the surrounding ones.
constexpr float kWindowPaths = 32.0f;

float squareOf(const vec3& v) { return glm::dot(v, v); }

// Soft threshold for a number of paths: 0 up to `least`, 1 from three times `least`.
float many(float paths, float least) {
  return std::clamp(0.5f * (paths / least - 1.0f), 0.0f, 1.0f);
}

// Certainty, from 0 to 1, that a fine band is not noise around a pixel: the agreement of the pixels
// there, minus the agreement by chance.
float sureness(const BandPowers& p) {
  return std::clamp((p.agreement - kByChance * std::sqrt(p.share)) / kAgreement, 0.0f, 1.0f);
}

// The slope of the residual over the picture in a band, by least squares over the surrounding
// pixels, as far as it is not noise; at least -1. It is -1 if the picture has a pattern that the
// paths do not have.
float slopeOverPicture(const BandPowers& p, float noise) {
  constexpr float kMost = 0.5f;
  const float square = p.withPicture * p.withPicture;
  const float chance = kSlopeVariances * noise * p.picture * p.share;
  if (!(square > chance)) return 0.0f;
  return (1.0f - chance / square) * std::clamp(p.withPicture / p.picture, -1.0f, kMost);
}

}  // namespace

ResidualFilter::ResidualFilter(const RepairGuides& guides, const Image& live, const PathSums& sums,
                               Estimate estimate)
    : guides_(guides),
      live_(live),
      paths_(sums),
      estimate_(estimate),
      residual_(guides.width, guides.height) {
  const size_t pixels = live.pixels.size();
  tame_.resize(pixels);
  bounds_.resize(pixels);
  nextBounds_.resize(pixels);
  sums_.resize(pixels);
  nextSums_.resize(pixels);
  variance_.resize(pixels);
  fineVariance_.resize(pixels);
  detail_.resize(pixels);
  powers_.resize(pixels);
  nextPowers_.resize(pixels);
  pictureDetail_.resize(pixels);
  noise_.resize(pixels);
  nextNoise_.resize(pixels);
  steps_.push_back([this](Rows rows) { begin(rows); });
  steps_.push_back([this](Rows rows) { weighBorders(rows); });
  steps_.push_back([this](Rows rows) { addBorders(rows); });
  for (int round = 0; round < kTamings; ++round) planTaming();
  steps_.push_back([this](Rows rows) { beginBands(rows); });
  for (int band = 0; band <= kBands; ++band) planBand(band);
  // The error of known light has no edges.
  if (estimate_ == Estimate::residual) return;
  steps_.push_back([this](Rows rows) { addWindow(rows); });
  if (paths_.knowsVariance()) planPixels();
}

ResidualFilter::~ResidualFilter() = default;

// The value that is subtracted from the estimate.
vec3 ResidualFilter::known(size_t pixel) const {
  return estimate_ == Estimate::truth ? live_.pixels[pixel] : vec3(0.0f);
}

int ResidualFilter::step(int mostRows) {
  const Rows rows{row_, std::min(row_ + mostRows, guides_.height)};
  steps_[next_](rows);
  row_ = rows.last;
  if (row_ == guides_.height) {
    row_ = 0;
    ++next_;
  }
  return rows.last - rows.first;
}

template <typename T>
void ResidualFilter::planMeans(std::vector<T>& of, std::vector<T>& next, int step) {
  steps_.push_back([this, &of, &next, step](Rows rows) {
    takeSurfaceMeans(guides_, rows, of, step, next);
    if (rows.last == guides_.height) of.swap(next);
  });
}

void ResidualFilter::planTaming() {
  steps_.push_back([this](Rows rows) { takeBounds(rows); });
  for (int step = 1; step <= kTamingStep; step *= 2) planMeans(bounds_, nextBounds_, step);
  steps_.push_back([this](Rows rows) { tame(rows); });
}

void ResidualFilter::planBand(int band) {
  const int step = 1 << std::min(band, kBands - 1);
  if (band < kBands) {
    steps_.push_back([this, band](Rows rows) {
      forSurfaces(guides_, rows, [&](int, int, size_t i) {
        variance_[i] = sums_[i].variance;
        if (band == kFineBands) fineVariance_[i] = sums_[i].variance;
      });
    });
    planMeans(sums_, nextSums_, step);
    steps_.push_back([this, band](Rows rows) { takeDetail(band, rows); });
  } else {
    steps_.push_back([this](Rows rows) { takeBase(rows); });
  }
  for (const int wider : {1, 2}) planMeans(powers_, nextPowers_, wider * step);
  steps_.push_back([this](Rows rows) {
    forSurfaces(guides_, rows, [&](int, int, size_t i) {
      noise_[i] = {powers_[i].noise, powers_[i].share};
    });
  });
  planMeans(noise_, nextNoise_, 4 * step);
  steps_.push_back([this, band](Rows rows) { addBand(band, rows); });
}

void ResidualFilter::planPixels() {
  steps_.push_back([this](Rows rows) {
    forSurfaces(guides_, rows, [&](int, int, size_t i) {
      noise_[i].noise = paths_.variance(i) / squareOf(guides_.albedo[i]);
    });
  });
  for (const int step : {1, 2, 4}) planMeans(noise_, nextNoise_, step);
  steps_.push_back([this](Rows rows) { addPixels(rows); });
}

vec3 ResidualFilter::mean(size_t pixel) const {
  return (paths_.first.pixels[pixel] + paths_.second.pixels[pixel]) / paths_.weight;
}

// Calls f(index) for all pixels in order: sums do not depend on the number of threads.
template <typename F>
void ResidualFilter::forRows(Rows rows, const F& f) const {
  const auto width = static_cast<size_t>(guides_.width);
  for (size_t i = static_cast<size_t>(rows.first) * width;
       i < static_cast<size_t>(rows.last) * width; ++i)
    f(i);
}

// Residuals of both halves.
void ResidualFilter::begin(Rows rows) {
  const float scale = 2.0f / paths_.weight;
  forRows(rows, [&](size_t i) {
    tame_[i] = {scale * paths_.first.pixels[i] - known(i),
                scale * paths_.second.pixels[i] - known(i)};
    light_ += static_cast<double>(squareOf(live_.pixels[i]));
    if (guides_.normal[i] == vec3(0.0f)) return;
    surfaceNoise_ += static_cast<double>(squareOf(tame_[i].half()));
    surfaceLight_ += static_cast<double>(squareOf(live_.pixels[i]));
  });
}

// In sums over the picture a pixel is weighted by the inverse of its power, so that the brightest
// pixels do not dominate.
double ResidualFilter::weight(size_t pixel) const {
  const double dark = kDark * light_ / static_cast<double>(live_.pixels.size());
  const double all = static_cast<double>(squareOf(live_.pixels[pixel])) + dark;
  return all > 0.0 ? 1.0 / all : 0.0;
}

void ResidualFilter::weighBorders(Rows rows) {
  forRows(rows, [&](size_t i) {
    if (guides_.normal[i] != vec3(0.0f)) return;
    const Halves& h = tame_[i];
    borderCommon_ += weight(i) * static_cast<double>(glm::dot(h.first, h.second));
    borderPower_ += weight(i) * static_cast<double>(squareOf(h.mean()));
  });
}

void ResidualFilter::addBorders(Rows rows) {
  const float share = borderPower_ > 0.0
                          ? static_cast<float>(std::clamp(borderCommon_ / borderPower_, 0.0, 1.0))
                          : 0.0f;
  forRows(rows, [&](size_t i) {
    if (guides_.normal[i] != vec3(0.0f)) return;
    residual_.pixels[i] = std::max(share, borderShare(i)) * (mean(i) - known(i));
  });
}

// The common share of power of the border pixels around a pixel: bars of a window that are thinner
// than a pixel are visible in both halves.
float ResidualFilter::borderShare(size_t pixel) const {
  const auto width = static_cast<size_t>(guides_.width);
  const int x = static_cast<int>(pixel % width), y = static_cast<int>(pixel / width);
  float common = 0.0f, power = 0.0f, noise = 0.0f;
  for (int v = std::max(y - kBorderRadius, 0); v <= std::min(y + kBorderRadius, guides_.height - 1);
       ++v)
    for (int u = std::max(x - kBorderRadius, 0);
         u <= std::min(x + kBorderRadius, guides_.width - 1); ++u) {
      const size_t k = static_cast<size_t>(v) * width + static_cast<size_t>(u);
      if (guides_.normal[k] != vec3(0.0f)) continue;
      common += glm::dot(tame_[k].first, tame_[k].second);
      power += squareOf(tame_[k].mean());
      noise += squareOf(tame_[k].half());
    }
  return power > 0.0f ? std::clamp((common - kBorderVariances * noise) / power, 0.0f, 1.0f) : 0.0f;
}

void ResidualFilter::takeBounds(Rows rows) {
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const vec3& albedo = guides_.albedo[i];
    bounds_[i] = {squareOf(2.0f * tame_[i].half() / albedo), squareOf(tame_[i].mean() / albedo)};
  });
}

// Bounds values that are far brighter in one half than in the other, or far brighter than their
// surroundings: single bright paths.
void ResidualFilter::tame(Rows rows) {
  const float mostResidual = kMostResidual + paths_.weight / kPathsABound;
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
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

void ResidualFilter::beginBands(Rows rows) {
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const vec3& albedo = guides_.albedo[i];
    const vec3 all = mean(i) - known(i);
    sums_[i] = {tame_[i], all - tame_[i].mean(), live_.pixels[i], albedo, 1.0f};
  });
  if (rows.last < guides_.height) return;
  smooth_ = tame_;
  smoothPicture_ = live_.pixels;
  bounds_ = {};
  nextBounds_ = {};
}

// The detail that the last means removed.
void ResidualFilter::takeDetail(int band, Rows rows) {
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const vec3 scale = guides_.albedo[i] / sums_[i].albedo;
    const Halves now{scale * sums_[i].tame.first, scale * sums_[i].tame.second};
    const Halves detail{smooth_[i].first - now.first, smooth_[i].second - now.second};
    smooth_[i] = now;
    detail_[i] = detail;
    const vec3 picture = scale * sums_[i].picture;
    pictureDetail_[i] = smoothPicture_[i] - picture;
    smoothPicture_[i] = picture;
    powers_[i] = BandPowers(detail, pictureDetail_[i]);
  });
  weighBand(band, rows);
}

// The remaining part: the mean over the whole surroundings, with the light above the bounds.
void ResidualFilter::takeBase(Rows rows) {
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const vec3 excess = guides_.albedo[i] / sums_[i].albedo * sums_[i].excess;
    variance_[i] = sums_[i].variance;
    detail_[i] = {smooth_[i].first + excess, smooth_[i].second + excess};
    powers_[i] = BandPowers(detail_[i]);
    pictureDetail_[i] = vec3(0.0f);
  });
  weighBand(kBands, rows);
}

void ResidualFilter::weighBand(int band, Rows rows) {
  if (rows.first == 0) band_ = {};
  forRows(rows, [&](size_t i) {
    if (guides_.normal[i] == vec3(0.0f)) return;
    const Halves& d = detail_[i];
    band_.add(d, variance_[i]);
    if (band >= kFineBands) error_ += weight(i) * static_cast<double>(glm::dot(d.first, d.second));
  });
}

float ResidualFilter::error() const {
  return static_cast<float>(
      std::sqrt(std::max(error_, 0.0) / static_cast<double>(live_.pixels.size())));
}

void ResidualFilter::addBand(int band, Rows rows) {
  const float paths = paths_.weight;
  const bool isFine = band < kFineBands;
  const Doubt& doubt = estimate_ == Estimate::residual ? kResidualDoubt
                       : isFine                        ? kFineDoubt
                                                       : kCoarseDoubt;
  const float wrong = isFine ? 0.0f : std::min(band_.share() / kWrong, 1.0f);
  const float usualPixels = (1.0f - wrong) * (doubt.usualPixels + kUsualPaths / paths);
  const float variances = doubt.variances * glm::mix(1.0f, kWrongVariances, wrong);
  const float leastPaths = glm::mix(kLeastPaths, kWrongPaths, wrong);
  if (band == kFineBands) windowVariances_ = variances;
  // Relative noise of a path: its variance divided by the square of the picture.
  const auto usualNoise =
      surfaceLight_ > 0.0 ? static_cast<float>(surfaceNoise_ / surfaceLight_) : 0.0f;
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const BandPowers& p = powers_[i];
    if (!(p.mean > 0.0f)) return;
    const float behind = paths / variance_[i];
    const float sure =
        isFine && estimate_ == Estimate::truth ? many(behind, kAgreePaths) * sureness(p) : 0.0f;
    const float usual = usualNoise * squareOf(live_.pixels[i]) * variance_[i];
    const float pixels = 1.0f / noise_[i].share, more = (1.0f - sure) * usualPixels;
    const float noise = (pixels * noise_[i].noise + more * usual) / (pixels + more);
    const float doubted = variances * glm::mix(1.0f, kWrongVariances, sure) * noise;
    const float shown = std::max(many(behind, leastPaths), sure) *
                        std::clamp((p.common - doubted) / p.mean, 0.0f, 1.0f);
    residual_.pixels[i] += shown * detail_[i].mean();
    if (estimate_ == Estimate::truth)
      residual_.pixels[i] += (1.0f - shown) * slopeOverPicture(p, noise) * pictureDetail_[i];
  });
}

// From 0 to 1: whether a pixel has few neighbours that show the same surface.
float ResidualFilter::aloneness(size_t pixel) const {
  return std::clamp(fineVariance_[pixel] / kAlone - 1.0f, 0.0f, 1.0f);
}

void ResidualFilter::addWindow(Rows rows) {
  const float side = std::sqrt(kWindowSamples / paths_.weight);
  const int radius = std::clamp(static_cast<int>(0.5f * side), kLeastRadius, kMostRadius);
  const float few = kWindowPaths / (kWindowPaths + paths_.weight);
  forSurfaces(guides_, rows, [&](int x, int y, size_t i) {
    const float alone = aloneness(i);
    if (alone == 0.0f) return;
    const Halves window = windowResidual(guides_, live_, tame_, x, y, radius);
    const float power = squareOf(window.mean());
    const float common = glm::dot(window.first, window.second);
    const float noise = windowVariances_ * squareOf(window.half());
    const float share = power > 0.0f ? std::clamp((common - noise) / power, 0.0f, 1.0f) : 0.0f;
    residual_.pixels[i] += alone * few * (share * window.mean() - residual_.pixels[i]);
  });
}

// Adds the residual that the bands leave out at single pixels: edges of surfaces and shadows that
// the picture has at the wrong place. It is shown where it far exceeds the noise of the paths of
// the pixel and of the surrounding ones, because paths that find no light show no noise.
void ResidualFilter::addPixels(Rows rows) {
  const float sure = kSurePixel * (1.0f + kFewGroups / paths_.groups);
  forSurfaces(guides_, rows, [&](int, int, size_t i) {
    const vec3 left = mean(i) - known(i) - residual_.pixels[i];
    const float power = squareOf(left);
    if (!(power > 0.0f)) return;
    const float noise = std::max(paths_.variance(i), squareOf(guides_.albedo[i]) * noise_[i].noise);
    const float variances = glm::mix(sure, kSureAlone, aloneness(i));
    residual_.pixels[i] += std::max(1.0f - variances * noise / power, 0.0f) * left;
  });
}

}  // namespace lamplighter
