#include "renderer/scene/sky_map.h"

#include <algorithm>
#include <cmath>

#include "shaders/shared/sky.h"

namespace lamplighter {

namespace {

constexpr int kMostCells = 512;  // along the horizon

// Limits that define a sun.
constexpr int kMostSuns = 4, kMostCandidates = 16;
constexpr float kSunShare = 0.02f;                // fraction of the total light
constexpr float kSunReach = 2.0f / 180.0f * kPi;  // largest angle from its brightest pixel [rad]
constexpr float kSunContrast = 0.125f;            // smallest luminance relative to its brightest
                                                  // pixel

// v: from the top [0, 1]; u: along the horizon.
vec3 directionOfCell(float u, float cosPolar) {
  const float azimuth = 2.0f * kPi * (u - 0.5f);
  const float sine = std::sqrt(std::max(0.0f, 1.0f - cosPolar * cosPolar));
  return {sine * std::sin(azimuth), cosPolar, -sine * std::cos(azimuth)};
}

// The solid angle of one pixel of row y: Δφ (cos θ0 − cos θ1), in a form without cancellation.
float pixelSolidAngle(const Image& image, int y) {
  const double step = static_cast<double>(kPi) / image.height;
  return static_cast<float>(2.0 * static_cast<double>(kPi) / image.width * 2.0 *
                            std::sin(step * (y + 0.5)) * std::sin(0.5 * step));
}

vec3 pixelDirection(const Image& image, int x, int y) {
  return directionOfCell(
      (static_cast<float>(x) + 0.5f) / static_cast<float>(image.width),
      std::cos(kPi * (static_cast<float>(y) + 0.5f) / static_cast<float>(image.height)));
}

}  // namespace

SkyMap::SkyMap(const Image& image) {
  if (image.empty()) return;
  pixels_ = vec2(image.width, image.height);
  factor_ = (image.width + kMostCells - 1) / kMostCells;
  width_ = (image.width + factor_ - 1) / factor_;
  height_ = (image.height + factor_ - 1) / factor_;

  std::vector<uint8_t> isSun(image.pixels.size(), 0);
  findSuns(image, isSun);

  // Mean radiance of cells without the suns, and weights for the density with the suns. The weights
  // include one more pixel on each side, because interpolation spreads light that far.
  cells_.assign(static_cast<size_t>(width_) * height_, vec3(0.0f));
  std::vector<float> weights(cells_.size()), wide(cells_.size());
  glm::dvec3 total(0.0);
  for (int cy = 0; cy < height_; ++cy) {
    const int y0 = cy * factor_, y1 = std::min(y0 + factor_, image.height);
    for (int cx = 0; cx < width_; ++cx) {
      const int x0 = cx * factor_, x1 = std::min(x0 + factor_, image.width);
      const size_t cell = static_cast<size_t>(cy) * width_ + cx;
      glm::dvec3 light(0.0);
      double around = 0.0, angleAround = 0.0, angle = 0.0;
      for (int y = y0 - 1; y <= y1; ++y) {
        const int row = std::clamp(y, 0, image.height - 1);
        const double solid = static_cast<double>(pixelSolidAngle(image, row));
        for (int x = x0 - 1; x <= x1; ++x) {
          const int column = (x + image.width) % image.width;
          const vec3& radiance = image.at(column, row);
          around += solid * static_cast<double>(luminance(radiance));
          angleAround += solid;
          if (y < y0 || y >= y1 || x < x0 || x >= x1) continue;
          angle += solid;
          if (isSun[static_cast<size_t>(row) * image.width + column] == 0)
            light += solid * glm::dvec3(radiance);
        }
      }
      total += light;
      cells_[cell] = vec3(light / angle);
      weights[cell] = luminance(vec3(light));
      wide[cell] = static_cast<float>(around / angleAround * angle);
    }
  }
  irradiance_ = vec3(total);
  light_ = GridCdf(width_, height_, weights);
  density_ = GridCdf(width_, height_, wide);
}

void SkyMap::findSuns(const Image& image, std::vector<uint8_t>& isSun) {
  double all = 0.0;
  std::vector<size_t> brightest(static_cast<size_t>(width_) * height_, 0);  // by cell: index of its
                                                                            // brightest pixel
  std::vector<float> peak(brightest.size(), -1.0f);
  for (int y = 0; y < image.height; ++y) {
    const double solid = static_cast<double>(pixelSolidAngle(image, y));
    for (int x = 0; x < image.width; ++x) {
      const size_t pixel = static_cast<size_t>(y) * image.width + x;
      const size_t cell = static_cast<size_t>(y / factor_) * width_ + x / factor_;
      const float l = luminance(image.pixels[pixel]);
      all += solid * static_cast<double>(l);
      if (l > peak[cell]) {
        peak[cell] = l;
        brightest[cell] = pixel;
      }
    }
  }
  // Candidates are the brightest pixels of cells, except those close to an earlier candidate.
  std::vector<vec3> looked;
  std::vector<size_t> order(peak.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = i;
  const size_t few = std::min<size_t>(order.size(), 4096);
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(few), order.end(),
      [&](size_t a, size_t b) { return peak[a] != peak[b] ? peak[a] > peak[b] : a < b; });
  for (size_t i = 0; i < few && looked.size() < kMostCandidates && suns_.size() < kMostSuns; ++i) {
    const size_t pixel = brightest[order[i]];
    const int px = static_cast<int>(pixel) % image.width,
              py = static_cast<int>(pixel) / image.width;
    const vec3 middle = pixelDirection(image, px, py);
    if (std::any_of(looked.begin(), looked.end(), [&](const vec3& d) {
          return glm::dot(d, middle) > std::cos(2.0f * kSunReach);
        }))
      continue;
    looked.push_back(middle);

    Sun sun;
    std::vector<float> weights;
    std::vector<size_t> members;
    glm::dvec3 light(0.0), towards(0.0);
    const int rows = 1 + static_cast<int>(kSunReach / kPi * static_cast<float>(image.height));
    for (int y = std::max(0, py - rows); y <= std::min(image.height - 1, py + rows); ++y) {
      const double solid = static_cast<double>(pixelSolidAngle(image, y));
      for (int x = 0; x < image.width; ++x) {
        const vec3& radiance = image.at(x, y);
        const vec3 d = pixelDirection(image, x, y);
        if (luminance(radiance) < kSunContrast * peak[order[i]] ||
            glm::dot(d, middle) < std::cos(kSunReach))
          continue;
        const double weight = solid * static_cast<double>(luminance(radiance));
        light += solid * glm::dvec3(radiance);
        towards += weight * glm::dvec3(d);
        weights.push_back(static_cast<float>(weight));
        members.push_back(static_cast<size_t>(y) * image.width + x);
        sun.towards.push_back(d);
        const float sine = std::sqrt(std::max(0.0f, 1.0f - d.y * d.y));
        sun.halfSize.push_back(kPi * vec2(sine / pixels_.x, 0.5f / pixels_.y));
      }
    }
    if (!(luminance(vec3(light)) > kSunShare * static_cast<float>(all))) continue;
    sun.mean = {vec3(glm::normalize(towards)), vec3(light)};
    sun.choice = AliasTable(weights);
    for (const size_t m : members) isSun[m] = 1;
    suns_.push_back(std::move(sun));
  }
}

vec3 SkyMap::Sun::direction(vec2 u) const {
  float rest;
  const size_t i = choice.sample(u.x, rest);
  const vec3& d = towards[i];
  const vec3 side = glm::normalize(vec3(-d.z, 0.0f, d.x) + vec3(1e-20f, 0.0f, 0.0f));
  const vec2 off = halfSize[i] * (2.0f * vec2(rest, u.y) - 1.0f);
  return glm::normalize(d + off.x * side + off.y * glm::cross(side, d));
}

float SkyMap::cellSolidAngle(int y) const {
  const double step = static_cast<double>(kPi) / static_cast<double>(pixels_.y);
  const double top = step * y * factor_;
  const double bottom = std::min(top + step * factor_, static_cast<double>(kPi));
  // For a cell of full width; the last cell of a row may be narrower, see directionIn().
  return static_cast<float>(2.0 * static_cast<double>(kPi) / static_cast<double>(pixels_.x) *
                            factor_ * 2.0 * std::sin(0.5 * (top + bottom)) *
                            std::sin(0.5 * (bottom - top)));
}

// Uniform over the solid angle of the cell.
vec3 SkyMap::directionIn(const GridCdf::Cell& cell) const {
  const auto factor = static_cast<float>(factor_);
  const vec2 low = vec2(cell.x, cell.y) * factor;
  const vec2 high = glm::min(low + factor, pixels_);
  const float top = std::cos(kPi * low.y / pixels_.y), bottom = std::cos(kPi * high.y / pixels_.y);
  return directionOfCell((low.x + cell.within.x * (high.x - low.x)) / pixels_.x,
                         top + cell.within.y * (bottom - top));
}

SkyMap::Light SkyMap::sample(vec2 u) const {
  if (light_.empty()) return {};
  const GridCdf::Cell cell = light_.sample(u);
  const vec3& radiance = cells_[static_cast<size_t>(cell.y) * width_ + cell.x];
  // mean · solid angle / probability, where probability ∝ luminance(mean) · solid angle.
  return {directionIn(cell), radiance * (luminance(irradiance_) / luminance(radiance))};
}

SkyMap::Direction SkyMap::sampleDensity(vec2 u) const {
  if (density_.empty()) return {};
  const vec3 towards = directionIn(density_.sample(u));
  return {towards, density(towards)};
}

float SkyMap::density(const vec3& towards) const {
  if (density_.empty()) return 0.0f;
  const vec2 at = shared::skyCoordinates(towards, 0.0f) * pixels_ / static_cast<float>(factor_);
  const int x = std::clamp(static_cast<int>(at.x), 0, width_ - 1);
  const int y = std::clamp(static_cast<int>(at.y), 0, height_ - 1);
  const float share =
      std::min(1.0f, pixels_.x / static_cast<float>(factor_) - static_cast<float>(x));
  return density_.probability(x, y) / (cellSolidAngle(y) * share);
}

}  // namespace lamplighter
