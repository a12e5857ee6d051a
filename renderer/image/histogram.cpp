#include "renderer/image/histogram.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <tbb/parallel_for.h>

namespace lamplighter {
namespace {

// The smallest exposed grey that the display shows as at least `shown` of 255.
float greyShownAs(float shown, ToneMapper mapper) {
  float low = 0.0f, high = 1e4f;
  for (int i = 0; i < 60; ++i) {
    const float middle = 0.5f * (low + high);
    (toneMapPixel(vec3(middle), 0.0f, mapper).g * 255.0f >= shown ? high : low) = middle;
  }
  return high;
}

struct BinCounts {
  std::array<uint64_t, Histogram::kBins> bins{};
  uint64_t white = 0, black = 0;
};

}  // namespace

uint64_t Histogram::most() const { return *std::max_element(bins.begin(), bins.end()); }

Histogram histogramOf(const Image& radiance, float exposureEv, ToneMapper mapper) {
  Histogram out;
  out.pixels = radiance.pixels.size();
  if (out.pixels == 0) return out;
  const float scale = std::exp2(exposureEv);
  const float white = greyShownAs(254.5f, mapper), black = greyShownAs(0.5f, mapper);
  constexpr float kPerStop = Histogram::kBins / (Histogram::kHighest - Histogram::kLowest);
  std::vector<BinCounts> rows(static_cast<size_t>(radiance.height));
  tbb::parallel_for(0, radiance.height, [&](int y) {
    BinCounts& counts = rows[static_cast<size_t>(y)];
    for (int x = 0; x < radiance.width; ++x) {
      const vec3 p = scale * radiance.at(x, y);
      const float brightest = std::max({p.r, p.g, p.b});
      if (brightest >= white) ++counts.white;
      if (!(brightest >= black)) ++counts.black;  // NaN is displayed as black, too
      const float l = luminance(p);
      const float stops = l > 0.0f ? std::log2(l) : Histogram::kLowest;
      const float at = std::isnan(stops) ? 0.0f : (stops - Histogram::kLowest) * kPerStop;
      ++counts.bins[static_cast<size_t>(std::clamp(at, 0.0f, Histogram::kBins - 1.0f))];
    }
  });
  uint64_t whites = 0, blacks = 0;
  for (const BinCounts& row : rows) {
    for (size_t i = 0; i < out.bins.size(); ++i) out.bins[i] += row.bins[i];
    whites += row.white;
    blacks += row.black;
  }
  out.white = static_cast<float>(whites) / static_cast<float>(out.pixels);
  out.black = static_cast<float>(blacks) / static_cast<float>(out.pixels);
  uint64_t below = 0;
  for (size_t i = 0; i < out.bins.size(); ++i) {
    below += out.bins[i];
    if (2 * below < out.pixels) continue;
    const float stops = Histogram::kLowest + (static_cast<float>(i) + 0.5f) / kPerStop;
    if (i > 0) out.median = std::exp2(stops) / scale;
    break;
  }
  return out;
}

}  // namespace lamplighter
