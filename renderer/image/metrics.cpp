#include "renderer/image/metrics.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "renderer/base/error.h"
#include "renderer/image/tone_map.h"

namespace lamplighter {

namespace {

void requireSameSize(const Image& a, const Image& b, const std::string& what) {
  if (a.width == b.width && a.height == b.height) return;
  throw InputError(what,
                   "pictures of " + std::to_string(a.width) + "x" + std::to_string(a.height) +
                       " and " + std::to_string(b.width) + "x" + std::to_string(b.height) +
                       " pixels cannot be compared",
                   "render both at the same size");
}

// Luma of the tone-mapped picture, in [0, 1].
std::vector<float> luma(const Image& image) {
  std::vector<float> out(image.pixels.size());
  std::transform(image.pixels.begin(), image.pixels.end(), out.begin(),
                 [](const vec3& p) { return luminance(toneMapPixel(p, 0.0f)); });
  return out;
}

// Filters with the separable Gaussian window of Wang et al. 2004 (11 wide, σ = 1.5); borders are
// repeated.
std::vector<float> gaussian(const std::vector<float>& in, int width, int height) {
  constexpr int kRadius = 5;
  float weights[2 * kRadius + 1], sum = 0.0f;
  for (int i = -kRadius; i <= kRadius; ++i)
    sum += weights[i + kRadius] = std::exp(-static_cast<float>(i * i) / (2.0f * 1.5f * 1.5f));
  for (float& w : weights) w /= sum;
  const auto pass = [&](const std::vector<float>& from, int dx, int dy) {
    std::vector<float> to(from.size());
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        float v = 0.0f;
        for (int i = -kRadius; i <= kRadius; ++i) {
          const int sx = std::clamp(x + i * dx, 0, width - 1),
                    sy = std::clamp(y + i * dy, 0, height - 1);
          v += weights[i + kRadius] * from[static_cast<size_t>(sy) * width + sx];
        }
        to[static_cast<size_t>(y) * width + x] = v;
      }
    }
    return to;
  };
  return pass(pass(in, 1, 0), 0, 1);
}

// Structural similarity (Wang, Bovik, Sheikh and Simoncelli 2004, eq. 13): mean over the pixels
// that count.
template <typename Counts>
double ssim(const Image& a, const Image& b, const Counts& counts) {
  const int w = a.width, h = a.height;
  const std::vector<float> x = luma(a), y = luma(b);
  std::vector<float> xx(x.size()), yy(x.size()), xy(x.size());
  for (size_t i = 0; i < x.size(); ++i) {
    xx[i] = x[i] * x[i];
    yy[i] = y[i] * y[i];
    xy[i] = x[i] * y[i];
  }
  const auto mx = gaussian(x, w, h), my = gaussian(y, w, h);
  const auto mxx = gaussian(xx, w, h), myy = gaussian(yy, w, h), mxy = gaussian(xy, w, h);
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  double sum = 0.0;
  size_t n = 0;
  for (size_t i = 0; i < x.size(); ++i) {
    if (!counts(i)) continue;
    ++n;
    const double ux = mx[i], uy = my[i];
    const double vx = mxx[i] - ux * ux, vy = myy[i] - uy * uy, cov = mxy[i] - ux * uy;
    sum += (2.0 * ux * uy + c1) * (2.0 * cov + c2) / ((ux * ux + uy * uy + c1) * (vx + vy + c2));
  }
  return sum / static_cast<double>(n);
}

// Colour ramp of a black body: black, deep red, orange, white.
vec3 heatColour(float t) {
  t = std::clamp(t, 0.0f, 1.0f);
  return {std::clamp(2.6f * t, 0.0f, 1.0f), std::clamp(2.6f * t - 0.9f, 0.0f, 1.0f),
          std::clamp(4.0f * t - 3.0f, 0.0f, 1.0f)};
}

// The pixels that a mask selects; all without a mask.
struct MaskedPixels {
  const Image* mask;
  bool operator()(size_t i) const { return mask == nullptr || mask->pixels[i].r > 0.5f; }
};

// Over the channels of the pixels that count.
struct ErrorSums {
  size_t count = 0;
  double a = 0.0, b = 0.0, squares = 0.0;  // squares: of A−B

  double meanA() const { return a / static_cast<double>(count); }
  double meanB() const { return b / static_cast<double>(count); }
  double relRmse() const {
    return squares == 0.0 ? 0.0 : std::sqrt(squares / static_cast<double>(count)) / meanB();
  }
};

ErrorSums sumsOf(const Image& a, const Image& b, const Image* mask) {
  requireSameSize(a, b, "compare");
  if (mask != nullptr) requireSameSize(*mask, b, "mask");
  const MaskedPixels counts{mask};
  ErrorSums sums;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (!counts(i)) continue;
    for (int c = 0; c < 3; ++c, ++sums.count) {
      const double va = static_cast<double>(a.pixels[i][c]),
                   vb = static_cast<double>(b.pixels[i][c]);
      sums.a += va;
      sums.b += vb;
      sums.squares += (va - vb) * (va - vb);
    }
  }
  if (sums.count == 0)
    throw InputError("compare", "there is no pixel to compare",
                     "give pictures that are not empty and a mask with white pixels");
  return sums;
}

}  // namespace

double relRmse(const Image& a, const Image& b, const Image* mask) {
  return sumsOf(a, b, mask).relRmse();
}

Metrics compareImages(const Image& a, const Image& b, const Image* mask) {
  const ErrorSums sums = sumsOf(a, b, mask);
  const MaskedPixels counts{mask};
  Metrics m;
  m.meanA = sums.meanA();
  m.meanB = sums.meanB();
  const double epsilon = std::pow(0.05 * m.meanB, 2.0);
  double relative = 0.0;
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    if (!counts(i)) continue;
    for (int c = 0; c < 3; ++c) {
      const double r = static_cast<double>(b.pixels[i][c]),
                   d = static_cast<double>(a.pixels[i][c]) - r;
      // Two black pixels are equal.
      if (d != 0.0) relative += d * d / (r * r + epsilon);
      if (!(std::abs(d) <= m.max)) m.max = std::abs(d);  // keeps NaN
    }
  }
  const bool isNan = std::isnan(sums.squares);
  if (isNan) m.max = std::numeric_limits<double>::quiet_NaN();
  m.relRmse = sums.relRmse();
  m.relMse = relative / static_cast<double>(sums.count);
  m.bias = m.meanA == m.meanB ? 1.0 : m.meanA / m.meanB;
  m.ssim = isNan ? std::numeric_limits<double>::quiet_NaN() : ssim(a, b, counts);
  return m;
}

Image8 heatMap(const Image& a, const Image& b) {
  requireSameSize(a, b, "heat map");
  double mean = 0.0;
  for (const vec3& p : b.pixels) mean += static_cast<double>(p.r + p.g + p.b) / 3.0;
  mean = std::max(mean / static_cast<double>(b.pixels.size()), 1e-20);
  Image8 out(a.width, a.height);
  for (size_t i = 0; i < a.pixels.size(); ++i) {
    const vec3 d = glm::abs(a.pixels[i] - b.pixels[i]);
    const float worst = std::max({d.r, d.g, d.b}) / static_cast<float>(mean);
    const vec3 colour =
        std::isnan(d.r + d.g + d.b) ? vec3(1, 0, 1) : heatColour(worst);  // NaN: magenta
    for (int c = 0; c < 3; ++c)
      out.pixels[4 * i + static_cast<size_t>(c)] = static_cast<uint8_t>(colour[c] * 255.0f + 0.5f);
  }
  return out;
}

}  // namespace lamplighter
